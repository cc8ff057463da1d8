// Runs that are recorded and replayed by the command: what is the same, what is not, and logs that can't be written.
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
#include "runtime/record/recorded_run.h"
#include "runtime/record/recording_writer.h"
#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"
#include "tools/commands/run/load_graph.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using command::content;
using command::TemporaryFolder;
namespace fs = std::filesystem;

// The line that begins with that word.
std::string line_of(const std::string& text, const std::string& word) {
  const std::size_t at = text.find("  " + word);
  return at == std::string::npos ? "" : text.substr(at + 2, text.find('\n', at) - at - 2);
}

}  // namespace

TEST_SUITE("tools/replay") {
  TEST_CASE("a run in real time is the same again, and its graph need not be named") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log", trace = folder / "run.csv", again = folder / "again.csv";
    const auto run = command::run_jarol("run specs/counting.yaml --clock real --force --for 300ms --log " + log +
                                        " --trace " + trace);
    CAPTURE(run.output);
    REQUIRE((run.exit_code == 0 || run.exit_code == 3));  // 3: the machine was late
    CHECK(line_of(run.output, "log") == "log         " + log);
    const auto replay = command::run_jarol("replay " + log + " --trace " + again);
    CHECK(replay.exit_code == 0);
    CHECK(line_of(replay.output, "same") == "same        as the run on the real clock");
    CHECK(line_of(replay.output, "digest") == line_of(run.output, "digest"));
    CHECK(line_of(replay.output, "activations") == line_of(run.output, "activations"));
    CHECK(content(again) == content(trace));
  }

  TEST_CASE("a recording does not say which files are read: what it does not hold is shown to nobody") {
    const TemporaryFolder folder;
    const std::string secret = folder.write("secret", "root:$6$hunter2:19000:0:99999:7:::\n"),
                      log = folder / "run.mcap";
    const Loaded loaded = tools::load_graph("specs/counting.yaml", {});
    RecordingWriter writer(log, {.graph = "counting", .file = secret, .overrides = {}, .clock = "virtual"}, {},
                           *loaded.graph);
    writer.open();
    writer.close({});
    for (const std::string& command : {"replay " + log, "log report " + log, "log csv " + log}) {
      CAPTURE(command);
      const auto refused = command::run_jarol(command, "2>&1");
      CHECK(refused.output.find("hunter2") == std::string::npos);
    }
    const auto refused = command::run_jarol("replay " + log, "2>&1");
    CHECK(refused.exit_code == 2);
    CHECK(refused.output.find("error: can't read '" + secret +
                              "': the recording does not hold it, and is not to say what else is read; name the graph: "
                              "jarol replay LOG FILE\n") != std::string::npos);
    CHECK(command::run_jarol("replay " + log + " specs/counting.yaml", "2>&1").exit_code != 2);
  }

  TEST_CASE("a replay with something changed says that it diverged") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log";
    const auto run = command::run_jarol("run specs/counting.yaml --for 100ms --log " + log);
    REQUIRE(run.exit_code == 0);
    const std::string digest = line_of(run.output, "digest").substr(12);
    CHECK(command::run_jarol("replay " + log + " specs/counting.yaml").exit_code == 0);
    const auto replay = command::run_jarol("replay " + log + " --set tasks.loop.init.out=7");
    CAPTURE(replay.output);
    CHECK(replay.exit_code == 1);
    CHECK(line_of(replay.output, "DIVERGED") == "DIVERGED    from the run on the virtual clock");
    CHECK(line_of(replay.output, "it had") == "it had      activations 27, instants 15, faults 0, digest " + digest);
    const auto json = command::run_jarol("replay " + log + " --json --set tasks.loop.init.out=7", "2>/dev/null");
    CHECK(json.exit_code == 1);
    CHECK(json.output.find("{\"schema\":\"jarol.replay/2\",") == 0);
    CHECK(json.output.find("\"verdict\":\"diverged\"") != std::string::npos);
    CHECK(json.output.find("\"log\":{\"file\":\"" + log +
                           "\",\"clock\":\"virtual\",\"values\":0,\"misses\":0,\"digest\":\"" + digest + "\"}") !=
          std::string::npos);
  }

  TEST_CASE("a replay reports between which seconds it diverged, and what else is not as it was") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log", graph = folder.write("g.yaml", R"(graph: g
tasks:
  count: {type: Counter, period: 100ms}
  sum: {type: Accumulate, period: 100ms, on_fault: hold}
connections: [count.out -> sum.in]
)");
    REQUIRE(command::run_jarol("run " + graph + " --for 5s --set tasks.count.offset=50ms --log " + log).exit_code == 0);
    // with the run's own --set it is the same; an offset puts the first difference into the first second
    CHECK(command::run_jarol("replay " + log).exit_code == 0);
    const auto replay = command::run_jarol("replay " + log + " --set tasks.count.offset=0ms");
    CHECK(replay.exit_code == 1);
    CHECK(line_of(replay.output, "DIVERGED") == "DIVERGED    from the run on the virtual clock, before 1 s");
    // what has changed since is said, and the run is replayed as it was
    const std::string changed =
        "  changed     '" + graph + "' is not what the run has read; it was replayed as it was then\n";
    folder.write("g.yaml", content(graph) + "# w\n");
    const auto as_it_was = command::run_jarol("replay " + log);
    CHECK(as_it_was.exit_code == 0);
    CHECK(as_it_was.output.ends_with("  same        as the run on the virtual clock\n" + changed));
    // another reader that publishes nothing: the same digest, and more activations
    std::string more = content(graph);
    folder.write("g.yaml", more.insert(more.find("tasks:\n") + 7, "  work: {type: Work, period: 100ms}\n"));
    CHECK(command::run_jarol("replay " + log).exit_code == 0);
    const auto other = command::run_jarol("replay " + log + " " + graph);
    CHECK(other.exit_code == 1);
    CHECK(other.output.find("  DIVERGED    from the run on the virtual clock after 4 s\n"
                            "  it had      activations 100, instants 100, faults 0, digest ") != std::string::npos);
    CHECK(other.output.ends_with("\n              the file of the graph is not what it was\n"));
    fs::rename(graph, folder / "moved.yaml");
    const auto gone = command::run_jarol("replay " + log);
    CHECK(gone.exit_code == 0);
    CHECK(gone.output.ends_with(changed));
    CHECK(command::run_jarol("replay " + log + " " + folder / "moved.yaml").exit_code == 1);
    // nobody waits for what a recording of somebody else names
    REQUIRE(::mkfifo(graph.c_str(), 0600) == 0);
    CHECK(command::run_jarol("replay " + log).output.ends_with(changed));
    fs::remove(graph);
    fs::create_symlink("/dev/zero", graph);
    CHECK(command::run_jarol("replay " + log).output.ends_with(changed));
  }

  TEST_CASE("of a log that breaks off the replay does what there is, and ends with 3") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log";
    REQUIRE(command::run_jarol("run specs/counting.yaml --for 2500ms --log " + log).exit_code == 0);
    const std::string whole = content(log);
    folder.write("part", whole.substr(0, whole.size() - 1));
    const auto replay = command::run_jarol("replay " + folder / "part", "2>/dev/null");
    CHECK(replay.exit_code == 3);
    const std::string why = "breaks off at byte " +
                            std::to_string(RecordedRun(folder / "part").recording().good_until()) +
                            ", before 2 s it is whole; how the run ended is not known\n";
    CHECK(replay.output.ends_with("  log         " + why));
    const std::string error = "error: '" + folder / "part" + "' " + why;
    CHECK(command::run_jarol("replay " + folder / "part", "2>&1 >/dev/null").output == error);
    CHECK(command::run_jarol("replay --json " + folder / "part", "2>&1 >/dev/null").output == error);
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
    const auto replay = command::run_jarol("replay " + log + " --json", "2>/dev/null");
    CHECK(replay.exit_code == 3);
    const auto reported = nlohmann::json::parse(replay.output);
    CHECK(reported["verdict"] == "unknown");
    CHECK(reported["simulated_ns"] >= 1'000'000'000);
    CHECK(reported["log"]["values"] >= 20);
    CHECK(reported["log"]["digest"].is_null());
  }
#endif

  TEST_CASE("a log that can't be written is an error, and the run's files are apart") {
    const TemporaryFolder folder;
    const std::string other = folder.write("other", "dear"), log = folder / "run.log";
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --log /no/such/place").output ==
          "error: can't write '/no/such/place': No such file or directory\n");
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --log " + other).output ==
          "error: can't write '" + other + "': it is there and no recording; choose another file, or remove it\n");
    CHECK(content(other) == "dear");
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --log /dev/full").output ==
          "error: can't write '/dev/full': No space left on device\n");
    // what is refused leaves an older log alone, what can't write its trace has its report
    REQUIRE(command::run_jarol("run specs/counting.yaml --for 1s --log " + log).exit_code == 0);
    const std::string old = content(log);
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --clock real --workers 2 --log " + log).exit_code == 2);
    CHECK(content(log) == old);
    const auto full = command::run_jarol("run specs/counting.yaml --for 1s --trace /dev/full --log " + log);
    CHECK(full.exit_code == 3);
    CHECK(full.output.find("counting: 1 s on the virtual clock") == 0);
    CHECK(full.output.ends_with("error: can't write '/dev/full': No space left on device\n"));
    CHECK(content(log) == old);
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --log specs/counting.yaml").output ==
          "error: --log 'specs/counting.yaml' would replace what FILE names; choose another file\n");
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --log x --clock real --concurrency threads").output ==
          "error: --log belongs to --concurrency exotasks\n");
  }

  TEST_CASE("a trace that can't be written takes neither recording, verdict nor replay with it") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", expect = " --set 'expect=[sum.out < 100000]'";
    const auto run = command::run_jarol("run specs/counting.yaml --for 2s --trace /dev/full --record " + file + expect);
    CHECK(run.exit_code == 3);
    CHECK(command::has(run.output, "  expected    sum.out < 100000: holds, "));
    CHECK(run.output.ends_with("error: can't write '/dev/full': No space left on device\n"));
    const std::string all = folder / "all.mcap";
    REQUIRE(command::run_jarol("run specs/counting.yaml --for 2s --record " + all + expect).exit_code == 0);
    CHECK(command::run_jarol("log diff " + file + " " + all).output ==
          command::run_jarol("log diff " + all + " " + all).output);
    const auto replay = command::run_jarol("replay " + all + " --trace /dev/full");
    CHECK(replay.exit_code == 3);
    CHECK(command::has(replay.output, "  same        as the run on the virtual clock, "));
    CHECK(command::has(replay.output, "  expected    sum.out < 100000: holds, "));
    CHECK(command::has(replay.output, "error: can't write '/dev/full': No space left on device\n"));
  }

  TEST_CASE("the page of a run that was ended on the way repeats it to where it came") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap";
    const auto run = command::run_jarol("run specs/counting.yaml --for 600s --pace 10 --json --record " + file,
                                        "2>/dev/null", "timeout -s INT 1 " JAROL_COMMAND);
    const auto ended = nlohmann::json::parse(run.output);
    CHECK(ended["ending"]["signal"] == "SIGINT");
    const std::string again = command::repeated_by(file);
    CHECK(again.starts_with("run specs/counting.yaml --seed 0 --for "));
    CHECK(command::json_report(again)["digest"] == ended["digest"]);
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("the page of a run that has lost its vehicle repeats that, too") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", air = "distributers.robostix.link.parameters.air.north=900 m/s";
    CHECK(
        command::run_jarol("run specs/javiator.yaml --set expect=nothing --set '" + air + "' --for 5s --record " + file)
            .exit_code == 3);
    const std::string again = command::repeated_by(file);
    CHECK(again.ends_with(" --seed 0 --for 5s"));
  }
#endif

  TEST_CASE("a log is whole, or the run says that it is not: wherever the room for it ends") {
    const TemporaryFolder folder;
    const std::string limited = folder / "limited.log";
    int failed = 0;
    constexpr int max = 30;
    for (int blocks = 1; blocks <= max; ++blocks) {
      CAPTURE(blocks);
      // in the middle of a record or between two
      const auto result = command::run_jarol(
          "schema > /dev/null; ulimit -f " + std::to_string(blocks) +
          "; " JAROL_COMMAND " run specs/counting.yaml --for 60s --record-compression none --log " + limited);
      if (result.exit_code == 0) {
        CHECK(RecordedRun(limited).end());
      } else {
        CHECK(result.exit_code == 3);
        CHECK(result.output.find("error: can't write '" + limited + "': File too large\n") != std::string::npos);
        // where there is no room for what the run is, it does not begin
        const bool has_begun = result.output.starts_with("counting: ");
        CHECK((has_begun || blocks < 5));
        if (has_begun) CHECK(!RecordedRun(limited).end());
        ++failed;
      }
      std::filesystem::remove(limited);
    }
    CHECK(failed > 4);
    CHECK(failed < max);
  }

  TEST_CASE("what a run was expected to do is judged where its log or trace can't be written, too") {
    const TemporaryFolder folder;
    const std::string run = "schema > /dev/null; ulimit -f 4; " JAROL_COMMAND
                            " run specs/counting.yaml --for 60s --set 'expect=[count.out < 3]'";
    const auto logged = command::run_jarol(run + " --record-compression none --log " + (folder / "l.log"));
    CHECK(logged.exit_code == 3);
    CHECK(logged.output.find("count.out < 3") != std::string::npos);
    const auto traced = command::run_jarol(run + " --set 'expect=[count.out < 1e9]' --trace " + (folder / "t.csv"));
    CHECK(traced.exit_code == 3);
    CHECK(command::has(traced.output, "  expected    count.out < 1e9: holds, "));
    CHECK(command::has(traced.output, "error: can't write '" + (folder / "t.csv") + "': File too large\n"));
  }
}
