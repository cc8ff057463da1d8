// Logs and their replays: what is in the file, what is the same, and what is wrong with a log.
// In one file: all cases damage or repeat the recordings of one graph.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#ifdef JAROL_VEHICLES
#include "tests/tools/process.h"
#endif
#include "runtime/execute/log_end.h"
#include "runtime/record/recorded_run.h"
#include "runtime/record/recording_writer.h"
#include "tests/runtime/outside.h"
#include "tests/runtime/trace_of.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using command::TemporaryFolder;
namespace fs = std::filesystem;

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The line that begins with that word.
std::string line_of(const std::string& text, const std::string& word) {
  const std::size_t at = text.find("  " + word);
  return at == std::string::npos ? "" : text.substr(at + 2, text.find('\n', at) - at - 2);
}

const std::string graph_text = R"(graph: t
timing: {period: 3ms}
distributers: {p: {type: Plant, link: {type: test}}}
communicators:
  i: {channel: p.sensor, period: 1ms}
  w: {channel: p.window}
  o: {channel: p.actuator, period: 1ms}
  mean: {type: double, direction: out}
tasks: {r: {type: Accumulate, period: 1ms, on_fault: hold}, m: {type: Mean}}
connections: [i -> r.in, r.out -> o, w -> m.in, m.out -> mean]
)";

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
  Executor executor(graph, replayed_channels(graph, log), {.misses = misses});
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

TEST_SUITE("tools/replay") {
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
      const std::string path = folder.write("longer", whole + more);
      const std::string wrong = "'" + path + "' goes on for " + std::to_string(more.size()) +
                                (more.size() == 1 ? " byte" : " bytes") +
                                " after its end; what was recorded is: head -c " + length + " " + path;
      CHECK(wrong_with(path) == wrong);
      const auto replay = command::jarol("replay " + path);
      CHECK(replay.exit_code == 2);
      CHECK(replay.output == "error: " + wrong + "\n");
    }
    CHECK(wrong_with(folder / "log") == "");
  }

  TEST_CASE("what is no recording is told, and of a log of before which version reads it") {
    const TemporaryFolder folder;
    const auto no_log = [&](const std::string& text) { return wrong_with(folder.write("x", text)); };
    const std::string x = "'" + folder / "x" + "' ",
                      is_none = x + "is no recording; one comes from jarol run --record or --log";
    CHECK(no_log("") == is_none);
    CHECK(no_log("graph: t\n") == is_none);
    CHECK(no_log("{\"schema\": \"jarol.run/1\"}\n") == is_none);
    CHECK(no_log("{\"schema\":\"jarol.log/1\",\"graph\":\"t\"}\n") ==
          x + "is a log of jarol 0.1.0, before logs were MCAP recordings; replay it with that version, or run again");
    CHECK(no_log(std::string(mcap::magic)) == is_none);
    write_log(folder / "log");
    std::string damaged = content(folder / "log");
    damaged[damaged.find("virtual")] = 'V';
    CHECK(no_log(damaged) == x + "is damaged at byte 30, before what was recorded, and can't be replayed");
    const std::string fifo = folder / "fifo";
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    const auto from_pipe = command::jarol("replay " + fifo);  // where nobody writes, nobody waits
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
    CHECK(wrong_with(folder / "nothing") == "can't read '" + folder / "nothing" + "': No such file or directory");
  }

  TEST_CASE("a log of another graph is told by what does not fit") {
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

  TEST_CASE("a run in real time is the same again, and its graph need not be named") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log", trace = folder / "run.csv", again = folder / "again.csv";
    const auto run =
        command::jarol("run specs/counting.yaml --clock real --force --for 300ms --log " + log + " --trace " + trace);
    CAPTURE(run.output);
    REQUIRE((run.exit_code == 0 || run.exit_code == 3));  // 3: the machine was late
    CHECK(line_of(run.output, "log") == "log         " + log);
    const auto replay = command::jarol("replay " + log + " --trace " + again);
    CHECK(replay.exit_code == 0);
    CHECK(line_of(replay.output, "same") == "same        as the run on the real clock");
    CHECK(line_of(replay.output, "digest") == line_of(run.output, "digest"));
    CHECK(line_of(replay.output, "activations") == line_of(run.output, "activations"));
    CHECK(content(again) == content(trace));
  }

  TEST_CASE("a replay with something changed says that it diverged") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log";
    const auto run = command::jarol("run specs/counting.yaml --for 100ms --log " + log);
    REQUIRE(run.exit_code == 0);
    const std::string digest = line_of(run.output, "digest").substr(12);
    CHECK(command::jarol("replay " + log + " specs/counting.yaml").exit_code == 0);
    const auto replay = command::jarol("replay " + log + " --set tasks.loop.init.out=7");
    CAPTURE(replay.output);
    CHECK(replay.exit_code == 1);
    CHECK(line_of(replay.output, "DIVERGED") == "DIVERGED    from the run on the virtual clock");
    CHECK(line_of(replay.output, "it had") == "it had      activations 27, instants 15, faults 0, digest " + digest);
    const auto json = command::jarol("replay " + log + " --json --set tasks.loop.init.out=7", "2>/dev/null");
    CHECK(json.exit_code == 1);
    CHECK(json.output.find("{\"schema\":\"jarol.replay/1\",") == 0);
    CHECK(json.output.find("\"verdict\":\"diverged\"") != std::string::npos);
    CHECK(json.output.find("\"log\":{\"file\":\"" + log +
                           "\",\"clock\":\"virtual\",\"values\":0,\"misses\":0,\"digest\":\"" + digest + "\"}") !=
          std::string::npos);
  }

  TEST_CASE("a replay tells between which seconds it diverged, and what else is not as it was") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log", graph = folder.write("g.yaml", R"(graph: g
tasks:
  count: {type: Counter, period: 100ms}
  sum: {type: Accumulate, period: 100ms, on_fault: hold}
connections: [count.out -> sum.in]
)");
    REQUIRE(command::jarol("run " + graph + " --for 5s --set tasks.count.offset=50ms --log " + log).exit_code == 0);
    // with the run's own --set it is the same; an offset puts the first difference into the first second
    CHECK(command::jarol("replay " + log).exit_code == 0);
    const auto replay = command::jarol("replay " + log + " --set tasks.count.offset=0ms");
    CHECK(replay.exit_code == 1);
    CHECK(line_of(replay.output, "DIVERGED") == "DIVERGED    from the run on the virtual clock, before 1 s");
    // what has changed since is said, and the run is replayed as it was
    const std::string changed =
        "  changed     '" + graph + "' is not what the run has read; it was replayed as it was then\n";
    folder.write("g.yaml", content(graph) + "# w\n");
    const auto as_it_was = command::jarol("replay " + log);
    CHECK(as_it_was.exit_code == 0);
    CHECK(as_it_was.output.ends_with("  same        as the run on the virtual clock\n" + changed));
    // another reader that publishes nothing: the same digest, and more activations
    std::string more = content(graph);
    folder.write("g.yaml", more.insert(more.find("tasks:\n") + 7, "  work: {type: Work, period: 100ms}\n"));
    CHECK(command::jarol("replay " + log).exit_code == 0);
    const auto other = command::jarol("replay " + log + " " + graph);
    CHECK(other.exit_code == 1);
    CHECK(other.output.find("  DIVERGED    from the run on the virtual clock after 4 s\n"
                            "  it had      activations 100, instants 100, faults 0, digest ") != std::string::npos);
    CHECK(other.output.ends_with("\n              the file of the graph is not what it was\n"));
    fs::rename(graph, folder / "moved.yaml");
    const auto gone = command::jarol("replay " + log);
    CHECK(gone.exit_code == 0);
    CHECK(gone.output.ends_with(changed));
    CHECK(command::jarol("replay " + log + " " + folder / "moved.yaml").exit_code == 1);
  }

  TEST_CASE("of a log that breaks off the replay does what there is, and ends with 3") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log";
    REQUIRE(command::jarol("run specs/counting.yaml --for 2500ms --log " + log).exit_code == 0);
    const std::string whole = content(log);
    folder.write("part", whole.substr(0, whole.size() - 1));
    const auto replay = command::jarol("replay " + folder / "part");
    CHECK(replay.exit_code == 3);
    CHECK(replay.output.find("  log         breaks off at byte ") != std::string::npos);
    CHECK(replay.output.find(", before 2 s it is whole; how the run ended is not known\n") != std::string::npos);
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("of a run that was killed the log has all but the end") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log";
    {
      tests::Process run("run specs/exolauv.yaml --clock real --force --for 60s --log " + log);
      const auto patience = std::chrono::steady_clock::now() + 30s;
      const auto covered = [&] {
        return fs::exists(log) && fs::file_size(log) > 2000 ? RecordedRun(log).covered() : 0s;
      };
      while (covered() < 1s && std::chrono::steady_clock::now() < patience) std::this_thread::sleep_for(50ms);
      run.kill();
    }
    const auto replay = command::jarol("replay " + log + " --json", "2>/dev/null");
    CHECK(replay.exit_code == 3);
    const auto told = nlohmann::json::parse(replay.output);
    CHECK(told["verdict"] == "unknown");
    CHECK(told["simulated_ns"] >= 1'000'000'000);
    CHECK(told["log"]["values"] >= 20);
    CHECK(told["log"]["digest"].is_null());
  }
#endif

  TEST_CASE("a log that can't be written is an error, and the run's files are apart") {
    const TemporaryFolder folder;
    const std::string other = folder.write("other", "dear"), log = folder / "run.log";
    CHECK(command::jarol("run specs/counting.yaml --for 1s --log /no/such/place").output ==
          "error: can't write '/no/such/place': No such file or directory\n");
    CHECK(command::jarol("run specs/counting.yaml --for 1s --log " + other).output ==
          "error: can't write '" + other + "': it is there and no recording; choose another file, or remove it\n");
    CHECK(content(other) == "dear");
    CHECK(command::jarol("run specs/counting.yaml --for 1s --log /dev/full").output ==
          "error: can't write '/dev/full': No space left on device\n");
    // what is refused leaves an older log alone, what can't write its trace has its report
    REQUIRE(command::jarol("run specs/counting.yaml --for 1s --log " + log).exit_code == 0);
    const std::string old = content(log);
    CHECK(command::jarol("run specs/counting.yaml --for 1s --clock real --workers 2 --log " + log).exit_code == 2);
    CHECK(content(log) == old);
    const auto full = command::jarol("run specs/counting.yaml --for 1s --trace /dev/full --log " + log);
    CHECK(full.exit_code == 3);
    CHECK(full.output.find("counting: 1 s on the virtual clock") == 0);
    CHECK(full.output.ends_with("error: can't write '/dev/full': No space left on device\n"));
    CHECK(content(log) == old);
    CHECK(command::jarol("run specs/counting.yaml --for 1s --log specs/counting.yaml").output ==
          "error: --log 'specs/counting.yaml' would replace what FILE names; choose another file\n");
    CHECK(command::jarol("run specs/counting.yaml --for 1s --log x --clock real --concurrency threads").output ==
          "error: --log belongs to --concurrency exotasks\n");
  }

  TEST_CASE("a log is whole, or the run says that it is not: wherever the room for it ends") {
    const TemporaryFolder folder;
    const std::string limited = folder / "limited.log";
    int failed = 0;
    constexpr int most = 30;
    for (int blocks = 1; blocks <= most; ++blocks) {
      CAPTURE(blocks);
      // in the middle of a record or between two
      const auto result = command::jarol(
          "schema > /dev/null; ulimit -f " + std::to_string(blocks) +
          "; " JAROL_COMMAND " run specs/counting.yaml --for 60s --record-compression none --log " + limited);
      if (result.exit_code == 0) {
        CHECK(RecordedRun(limited).end());
      } else {
        // where there is no room for what the run is, it does not begin
        CHECK((result.exit_code == 3 || (result.exit_code == 2 && blocks < 5)));
        CHECK(result.output.find("error: can't write '" + limited + "': File too large\n") != std::string::npos);
        if (result.exit_code == 3) CHECK(!RecordedRun(limited).end());
        ++failed;
      }
      std::filesystem::remove(limited);
    }
    CHECK(failed > 4);
    CHECK(failed < most);
  }

  TEST_CASE("what a run was expected to do is judged where its log can't be written, too") {
    const TemporaryFolder folder;
    const std::string run = "schema > /dev/null; ulimit -f 4; " JAROL_COMMAND
                            " run specs/counting.yaml --for 60s --set 'expect=[count.out < 3]'";
    const auto logged = command::jarol(run + " --record-compression none --log " + (folder / "l.log"));
    CHECK(logged.exit_code == 3);
    CHECK(logged.output.find("count.out < 3") != std::string::npos);
    // what was not seen to its end can't hold, and says why
    const auto traced = command::jarol(run + " --set 'expect=[count.out < 1e9]' --trace " + (folder / "t.csv"));
    CHECK(traced.exit_code == 3);
    CHECK(traced.output.find("not judged: can't write '" + (folder / "t.csv") + "': File too large\n") !=
          std::string::npos);
  }
}
