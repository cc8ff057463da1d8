// What is said when a task ends the whole process, whoever runs it.
#include <doctest/doctest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/tools/guarded_run.h"
#include "tests/tools/process.h"

namespace {
using command::TemporaryFolder;
using jarol::tests::Process;

// Two pilots that feed nobody, of which one crashes in its fourth activation.
std::string crashing(const TemporaryFolder& folder, const std::string& way) {
  const std::string plugin = std::filesystem::absolute(JAROL_PLUGIN_FOLDER "/crash.so").string();
  return folder.write("crash.yaml", "graph: g\nplugins: [" + plugin +
                                        "]\ntiming: {period: 10ms}\n"
                                        "communicators: {c: {type: JaviatorSensors, direction: in}}\n"
                                        "tasks:\n  a: {type: CrashingPilot, isolation: weak, on_fault: hold}\n  b: "
                                        "{type: CrashingPilot, isolation: weak, on_fault: hold, parameters: "
                                        "{way: " +
                                        way +
                                        ", at: 3}}\n"
                                        "  d: {type: CrashingPilot, isolation: weak, on_fault: hold, let: 5ms}\n"
                                        "connections: [c -> a.sensors, c -> b.sensors, c -> d.sensors]\n");
}
const std::string line = "crash: task 'b' activation 3 at 0.03 s: ";

// In real time a busy machine may have left that activation out.
bool names_task(const Process& process, const std::string& how, const std::string& cause) {
  if (how.find("real") == std::string::npos) return process.errors().find(line + cause) != std::string::npos;
  const std::size_t begin = process.errors().find("crash: task 'b' activation ");
  return begin != std::string::npos && process.errors().find(" s: " + cause, begin) != std::string::npos;
}
}  // namespace

TEST_SUITE("tools/crash_line") {
  TEST_CASE("each crash ends the process with one line, on every clock and by any number of workers") {
    const TemporaryFolder folder;
    struct Way {
      std::string name, cause;
      int exit_code;
    };
    for (const Way& way : {Way{"exit", "called exit(0); the process ends\n", 3},
                           Way{"quick_exit", "called quick_exit; the process ends\n", 3},
                           Way{"underscore_exit", "called _exit(0); the process ends\n", 3},
                           Way{"abort", "abort; the process ends\n", -SIGABRT},
                           Way{"segmentation", "segmentation fault at address 0x0; the process ends\n", -SIGSEGV},
                           Way{"overflow", "stack overflow at address 0x", -SIGSEGV},
                           Way{"terminate", "abort; the process ends\n", -SIGABRT},
                           Way{"divide", "arithmetic exception; the process ends\n", -SIGFPE}}) {
      const std::string &name = way.name, &cause = way.cause;
      const int exit_code = way.exit_code;
      const std::string file = crashing(folder, name);
      for (const std::string how :
           {"run ", "run --workers 3 ", "run --set tasks.b.let=8ms ", "run --clock real ",
            "run --clock real --concurrency threads ",
            "run --clock real --set 'platform={cores: 1, policy: fixed_priority}' ", "check --measure "}) {
        CAPTURE(how + name);
        Process process(how + file + " --for 1s");
        CHECK(process.end() == exit_code);
        CHECK(names_task(process, how, cause));
        CHECK(process.output() == "");
      }
    }
  }

  TEST_CASE("a thread that a task has started may not end the process unseen either") {
    const TemporaryFolder folder;
    const std::string file = crashing(folder, "thread_exit");
    for (const std::string how : {"run ", "run --clock real ", "check --measure "}) {
      CAPTURE(how);
      Process process(how + file + " --for 1s");
      CHECK(process.end() == 3);
      CHECK(process.errors().find("crash: no task ran in this thread: called exit(0); the process ends\n") !=
            std::string::npos);
      CHECK(process.output() == "");
    }
  }

  TEST_CASE("what another process sends is no task's fault") {
    const TemporaryFolder folder;
    Process process("run " + crashing(folder, "none") + " --clock real --for 1h");
    // its handlers stand as soon as it has the last, which no sanitizer has
    for (bool stands = false; !stands;) {
      std::ifstream status("/proc/" + std::to_string(process.id()) + "/status");
      for (std::string text; std::getline(status, text);)
        if (text.starts_with("SigCgt:")) stands = (std::stoull(text.substr(8), nullptr, 16) >> (SIGSYS - 1) & 1) != 0;
    }
    kill(process.id(), SIGSEGV);
    CHECK(process.end() == -SIGSEGV);
    CHECK(process.errors().find("crash: segmentation fault, sent by process " + std::to_string(getpid()) +
                                "; the process ends\n") != std::string::npos);
  }

  TEST_CASE("the log of a run that crashed is whole to its last chunk, and a replay goes as far") {
    const TemporaryFolder folder;
    struct Run {
      std::string log, way;
      std::unique_ptr<Process> process;
    };
    std::vector<Run> runs;
    const std::string file = crashing(folder, "none");
    for (const std::string way : {"exit", "abort", "segmentation", "overflow"}) {
      const std::string log = folder / (way + ".log");
      runs.push_back({log, way,
                      std::make_unique<Process>("run " + file + " --clock real --for 1h --set " +
                                                "'tasks.b.parameters={way: " + way + ", at: 250}' --log " + log)});
    }
    for (const Run& run : runs) {
      CAPTURE(run.way);
      run.process->end();
      CHECK(names_task(*run.process, "real", ""));
      CHECK(run.process->errors().find("note: the recording '" + run.log +
                                       "' is good up to its last chunk: jarol replay " + run.log + "\n") !=
            std::string::npos);
      const auto replay = command::run_jarol("replay --json " + run.log + " " + file, "2>/dev/null");
      CHECK(replay.exit_code == 3);
      const auto json = nlohmann::json::parse(replay.output);
      CHECK(json["verdict"] == "unknown");
      CHECK(json["same_until_ns"] == 2'000'000'000);
    }
  }

  TEST_CASE("a replay names the task as well") {
    const TemporaryFolder folder;
    const std::string log = folder / "good.log", file = crashing(folder, "none");
    REQUIRE(command::run_jarol("run " + file + " --for 1s --log " + log).exit_code == 0);
    crashing(folder, "segmentation");  // the same file, changed
    Process replay("replay " + log + " " + file);
    CHECK(replay.end() == -SIGSEGV);
    CHECK(replay.errors().find(line + "segmentation fault at address 0x0; the process ends\n") != std::string::npos);
  }

  TEST_CASE("a text that is thrown may have any bytes, and the report is JSON all the same") {
    const TemporaryFolder folder;
    const auto run = command::run_jarol(
        "run " + crashing(folder, "bytes") + " --for 1s --json --set tasks.b.on_fault=stop", "2>/dev/null");
    CHECK(run.exit_code == 3);
    const auto json = nlohmann::json::parse(run.output);
    CHECK(json["faults"][0]["task"] == "b");
    const std::string replaced = "\xef\xbf\xbd";
    CHECK(json["faults"][0]["cause"] ==
          "threw: " + replaced + replaced + "( \x1b[31m \x01" + replaced + replaced + replaced + "\"\\");
  }
}
