// How a campaign ends where something is in its way: a task that crashes, results that are removed, outputs that can't
// be made.
#include <doctest/doctest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::TemporaryFolder;
using jarol::tests::Process;

const std::string counting = "campaign specs/counting.yaml --for 1s --vary seed=1..3 ";
}  // namespace

TEST_SUITE("tools/commands/campaign/ends") {
  TEST_CASE("a crash names the run, and runs before it are in the results") {
    const TemporaryFolder folder;
    const std::string plugin = std::filesystem::absolute(JAROL_PLUGIN_FOLDER "/crash.so").string();
    const std::string file = folder.write(
        "crash.yaml", "graph: g\nplugins: [" + plugin +
                          "]\ntiming: {period: 10ms}\n"
                          "communicators: {c: {type: JaviatorSensors, direction: in}}\n"
                          "tasks: {b: {type: CrashingPilot, isolation: weak, on_fault: hold, parameters: {at: 3}}}\n"
                          "connections: [c -> b.sensors]\n");
    struct Way {
      std::string name, cause;
      int exit_code;
    };
    for (const Way& way : {Way{"exit", "called exit(0); the process ends\n", 3},
                           Way{"segmentation", "segmentation fault at address 0x0; the process ends\n", -SIGSEGV},
                           Way{"overflow", "stack overflow at address 0x", -SIGSEGV}}) {
      for (const std::string workers : {"1", "2"}) {
        CAPTURE(way.name + " " + workers);
        const std::string results = folder / (way.name + workers);
        Process process("campaign " + file + " --for 1s --vary 'tasks.b.parameters.way=[none, none, " + way.name +
                        ", none]' --workers " + workers + " --results " + results);
        CHECK(process.end() == way.exit_code);
        CHECK(process.errors().find("crash: run 2 of the campaign: task 'b' activation 3 at 0.03 s: " + way.cause) !=
              std::string::npos);
        CHECK(process.output() == "");
        if (workers == "1")
          CHECK(command::run_jarol("campaign " + file + " --for 1s --vary 'tasks.b.parameters.way=[none, none, " +
                                       way.name + ", none]' --shard 1/2 --results " + results,
                                   "2>/dev/null")
                    .output.starts_with("g, shard 1/2 (runs 0 to 1): 2 of 2 runs, 2 good\n"));
      }
    }
  }

  TEST_CASE("a campaign that is interrupted says for how many runs it waits, and a second Ctrl-C ends it") {
    const TemporaryFolder folder;
    const std::string plugin = std::filesystem::absolute(JAROL_PLUGIN_FOLDER "/endless.so").string();
    const std::string file =
        folder.write("endless.yaml", "graph: g\nplugins: [" + plugin +
                                         "]\ntiming: {period: 10ms}\ntasks: {e: {type: Endless, wcet: 1us}}\n");
    Process process("campaign " + file + " --for 1s --vary seed=1..4 --workers 2 --results " + (folder / "r"));
    for (int i = 0; i < 2000 && !std::filesystem::exists(folder / "r-wal"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    process.interrupt();
    CHECK(
        process.says("note: waits for 2 runs to end; Ctrl-C again ends the campaign at once, with the results of all "
                     "runs that are done\n"));
    process.interrupt();
    CHECK(process.end() == -SIGINT);
    CHECK(process.errors().ends_with("interrupted again: ended at once, without a report\n"));
  }

  TEST_CASE("a table or page that can't be made is reported before the first run, and one that stands there stays") {
    const TemporaryFolder folder;
    for (const std::string option : {"--csv", "--report"}) {
      CAPTURE(option);
      const std::string results = " --results " + (folder / "r"), file = folder / "no/folder/a.html";
      const auto refused = command::run_jarol(counting + option + " " + file + results);
      CHECK(refused.exit_code == 2);
      CHECK(refused.output == "error: can't write '" + file + "': No such file or directory\n");
      CHECK(!std::filesystem::exists(folder / "r"));
      const std::string there = folder.write("a.html", "of an earlier campaign");
      REQUIRE(command::run_jarol(counting + "--results " + (folder / "other")).exit_code == 0);
      const auto other =
          command::run_jarol(counting + "--seed 5 " + option + " " + there + " --results " + (folder / "other"));
      CHECK(other.exit_code == 2);
      CHECK(content(there) == "of an earlier campaign");
      REQUIRE(command::run_jarol(counting + option + " " + there + results).exit_code == 0);
      CHECK(content(there).size() > 40);
      std::filesystem::remove(folder / "r");
    }
  }

  TEST_CASE("results that would end with the process are refused") {
    const auto refused = command::run_jarol(counting + "--results :memory:");
    CHECK(refused.exit_code == 2);
    CHECK(refused.output ==
          "error: --results: ':memory:' is no file, and results that end with the process are of no use; name a file, "
          "as in --results campaign.sqlite\n");
  }

  TEST_CASE("a name of results that SQLite would take for an address is a name") {
    const std::string name = "file:jarol_results_" + std::to_string(::getpid()) + "?mode=memory";
    const auto done = command::run_jarol(counting + "--results '" + name + "'");
    CHECK(done.exit_code == 0);
    CHECK(std::filesystem::remove(name));
  }

  TEST_CASE("results that are removed during the campaign are reported as lost, behind what they came to") {
    const TemporaryFolder folder;
    const std::string results = folder / "r";
    const auto lost = command::run_jarol(
        "campaign specs/counting.yaml --for 3000s --vary seed=1..4 --workers 1 --results " + results,
        "2>&1 & id=$!; until [ -s " + results + "-wal ] || ! kill -0 $id 2>&-; do sleep 0.01; done; rm " + results +
            "*; wait $id; echo code $?");
    CHECK(lost.output.starts_with("counting: 4 of 4 runs, 4 good; 4 of them in "));
    CHECK(lost.output.ends_with("error: the results are lost: '" + results +
                                "' was removed or replaced while the campaign was running; the same command runs it "
                                "anew\ncode 3\n"));
  }
}
