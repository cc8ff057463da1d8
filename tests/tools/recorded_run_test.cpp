// What a recording holds, cut off and damaged anywhere, and the graphs that it fits.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <regex>
#include <string>

#include "runtime/execute/log_end.h"
#include "runtime/record/recorded_run.h"
#include "runtime/record/recording_writer.h"
#include "tests/runtime/outside.h"
#include "tests/runtime/trace_of.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using command::content;
using command::TemporaryFolder;

const std::string graph_text = tests::plant_graph;

Graph graph_of(const std::string& text) {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(tests::plant());
    return made;
  }();
  return tests::graph_of(registry, text);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

// A log of 30 ms with `r` late at 12 ms, and the report of the run.
Report write_log(const std::string& path, Duration end = 30ms) {
  const Graph graph = graph_of(graph_text);
  RecordingWriter log(path, {.graph = "t", .file = "/t.yaml", .overrides = {}, .clock = "virtual"}, {}, graph);
  const std::vector<Miss> misses{{.activation = 12, .ended_after = 1'200'000, .task = 1, .left_out = 0}};
  log.open();
  Executor executor(graph, tests::outside(), {.log = log.recorder(), .misses = misses});
  executor.run_until(end);
  log.close(log_end_of(executor.report()));
  return executor.report();
}

// Where the first chunk begins.
std::size_t first_chunk(const std::string& path) { return Recording(path).chunks().at(0).offset; }

Report replay(RecordedRun& log, const Graph& graph) {
  const std::vector<Miss> misses = log.begin(graph);
  Executor executor(graph, replayed_systems(graph, log), {.misses = misses});
  executor.run_until(log.covered());
  log.require_all_taken();
  return executor.report();
}

// What is wrong with a log, or with the graph that it is replayed with.
std::string wrong_with(const std::string& path, const std::string& text = graph_text) {
  try {
    RecordedRun log(path);
    replay(log, graph_of(text));
  } catch (const LogError& error) { return error.what(); }
  return "";
}
}  // namespace

TEST_SUITE("tools/recorded_run") {
  TEST_CASE("values of any type come back from a log, each at its instant, as often as they are asked for") {
    const TemporaryFolder folder;
    const Report should = write_log(folder / "log");
    RecordedRun log(folder / "log");
    CHECK(log.covered() == 30ms);
    CHECK(log.values() > 0);
    REQUIRE(log.end());
    CHECK(log.end()->digest == should.digest);
    CHECK(log.end()->instants == 30);
    CHECK(log.end()->activations == should.activations);
    const Graph graph = graph_of(graph_text);
    for (int i = 0; i < 2; ++i) CHECK(replay(log, graph).digest == should.digest);
  }

  TEST_CASE("what was late is so again, also where tasks have other numbers") {
    const TemporaryFolder folder;
    const Report should = write_log(folder / "log");
    REQUIRE(should.fault_count == 1);
    RecordedRun log(folder / "log");
    CHECK(log.end()->faults == 1);
    const Report again = replay(log, graph_of(replaced(graph_text, "tasks: {", "tasks: {aa: {type: Work}, ")));
    CHECK(again.digest == should.digest);
    REQUIRE(again.fault_count == 1);
    CHECK(to_text(again.faults[0]) ==
          "task 'r' activation 12 at 0.012 s: late: ended 1.2ms after its release, deadline 1ms");
  }

  TEST_CASE("a log that breaks off anywhere, or is damaged, is good up to the digest before, or to its end") {
    const TemporaryFolder folder;
    const Report should = write_log(folder / "log", 3s);
    const std::string whole = content(folder / "log");
    const std::size_t begin = first_chunk(folder / "log");
    Duration covered{};
    std::size_t ended = 0;
    for (std::size_t length = begin; length < whole.size(); length += 97) {
      CAPTURE(length);
      std::string damaged = whole;
      damaged[length] = static_cast<char>(damaged[length] ^ 0x10);
      for (const std::string& text : {damaged, whole.substr(0, length)}) {
        folder.write("part", text);
        RecordedRun log(folder / "part");
        if (log.end()) {
          // what is damaged stands where only those who seek look
          REQUIRE(text.size() == whole.size());
          if (length % 5 == 0) CHECK(replay(log, graph_of(graph_text)).digest == should.digest);
          ++ended;
          continue;
        }
        REQUIRE(log.good_until() <= length);
        if (text.size() < whole.size()) {
          REQUIRE(log.covered() >= covered);
          covered = log.covered();
        }
        const Report part = replay(log, graph_of(graph_text));
        CHECK(part.covered == log.covered());
        // one that breaks off between its end and the mark behind has all digests, and its end is not counted
        CHECK(part.digest == (log.digests().empty() ? 0 : log.digests().back().digest));
      }
    }
    CHECK(covered == 2s);
    CHECK(ended > 0);
  }

  TEST_CASE("a log with anything after its end is refused, with where it ends") {
    const TemporaryFolder folder;
    write_log(folder / "log", 1500ms);
    const std::string whole = content(folder / "log"), length = std::to_string(whole.size());
    for (const std::string& more : {std::string("x"), std::string(1, '\0'), whole}) {
      const std::string path = folder.write("longer one", whole + more);
      const std::string wrong = "'" + path + "' goes on for " + std::to_string(more.size()) +
                                (more.size() == 1 ? " byte" : " bytes") +
                                " after its end; what was recorded is: head -c " + length + " '" + path + "'";
      CHECK(wrong_with(path) == wrong);
      const std::string file = "'" + path + "'";
      const auto replay = command::run_jarol("replay " + file);
      CHECK(replay.exit_code == 2);
      CHECK(replay.output == "error: " + wrong + "\n");
      // what only shows it shows it up to there, and says so
      for (const std::string& shown :
           {"cat " + file, "csv --topic jarol/digests " + file, "diff " + file + " " + folder / "log"})
        CHECK(command::run_jarol("log " + shown, "2>&1 >/dev/null").output == "note: " + wrong + "\n");
    }
    CHECK(wrong_with(folder / "log") == "");
  }

  TEST_CASE("what is no recording is refused, and of a log of before it is said which version reads it") {
    const TemporaryFolder folder;
    const auto no_log = [&](const std::string& text) { return wrong_with(folder.write("x", text)); };
    const std::string x = "'" + folder / "x" + "' ",
                      is_none = x + "is no recording; one comes from jarol run --record or --log";
    CHECK(no_log("") == is_none);
    CHECK(no_log("graph: t\n") == is_none);
    CHECK(no_log("{\"schema\": \"jarol.run/2\"}\n") == is_none);
    CHECK(no_log("{\"schema\":\"jarol.log/1\",\"graph\":\"t\"}\n") ==
          x + "is a log of jarol 0.1.0, before logs were MCAP recordings; replay it with that version, or run again");
    CHECK(no_log(std::string(mcap::magic)) == is_none);
    write_log(folder / "log");
    std::string damaged = content(folder / "log");
    damaged[damaged.find("virtual")] = 'V';
    CHECK(no_log(damaged) == x + "is damaged at byte 30, before what was recorded, and can't be replayed");
    const std::string fifo = folder / "fifo";
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    const auto from_pipe = command::run_jarol("replay " + fifo);  // where nobody writes, nobody waits
    CHECK(from_pipe.exit_code == 2);
    CHECK(from_pipe.output == "error: '" + fifo + "' is no regular file, and a recording is read twice; give a file\n");
    const auto with_header = [&](const std::string& json) {
      std::FILE* file = std::fopen((folder / "x").c_str(), "wb");
      mcap::Writer(file, mcap::Compression::none, "jarol").write({"jarol.json", "", json});
      std::fclose(file);
      return wrong_with(folder / "x");
    };
    CHECK(with_header("{}") == is_none);
    CHECK(with_header("{\"schema\": \"jarol.recording/1\", \"graph\": 3}") == is_none);
    CHECK(with_header("{\"schema\": " + std::string(1'000'000, '[')) == is_none);
    const std::string whole = content(folder / "log");
    const std::size_t begin = whole.rfind('{', whole.find("jarol.recording/1"));
    const std::string header = whole.substr(begin, whole.find("\n}\n", begin) + 3 - begin);
    CHECK(with_header(header) != is_none);
    for (const std::string time : {"until", "mission"}) {
      const std::string before = std::regex_replace(header, std::regex("\"" + time + "_ns\": "), "$&-1");
      CHECK(before != header);
      CHECK(with_header(before) == is_none);
    }
    CHECK(wrong_with(folder / "nothing") == "can't read '" + folder / "nothing" + "': No such file or directory");
  }

  TEST_CASE("a log of another graph is refused by what does not fit") {
    const TemporaryFolder folder;
    write_log(folder / "log");
    const std::string log = "'" + folder / "log" + "' ", remedy = "; replay the graph of the run";
    CHECK(wrong_with(folder / "log") == "");
    CHECK(wrong_with(folder / "log", replaced(replaced(graph_text, "  i:", "  j:"), "i -> r", "j -> r")) ==
          log + "has values of 'i', which takes none in graph 't'" + remedy);
    CHECK(wrong_with(folder / "log", replaced(replaced(replaced(graph_text, "{r:", "{q:"), "> r.in", "> q.in"),
                                              ", r.out", ", q.out")) ==
          log + "says that task 'r' was late, which is not in graph 't'" + remedy);
    std::string other = graph_text;
    for (const auto& [what, by] : {std::pair("  w: {channel: p.window}\n", ""),
                                   {", m: {type: Mean}", ""},
                                   {", w -> m.in, m.out -> mean", ", r.out -> mean"}})
      other = replaced(other, what, by);
    CHECK(wrong_with(folder / "log", other) == log + "has values of 'w', which takes none in graph 't'" + remedy);
    CHECK(wrong_with(folder / "log", replaced(graph_text, "period: 1ms}\n", "period: 1ms, offset: 500us}\n"))
              .find(log + "has a value of 'i' at 0") == 0);
    const std::string flat = replaced(replaced(replaced(graph_text, "p.window", "p.sensor"), "p.sensor", "p.window"),
                                      "tasks: {r: {type: Accumulate, period: 1ms, on_fault: hold}, m: {type: Mean}}",
                                      "tasks: {r: {type: Mean, period: 1ms}, m: {type: Accumulate}}");
    CHECK(wrong_with(folder / "log", flat) == log + "has values of 'i', which have another type in graph 't'" + remedy);
  }
}
