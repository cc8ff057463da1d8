// Overruns on the desk: run --execution.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::error_of;
using command::report_of;
using command::TemporaryFolder;
using nlohmann::json;

const std::string counting = "specs/counting.yaml --for 3s ";
const std::string holds = counting +
                          "--set fault_limit=100% --set tasks.slow.on_fault=hold --set tasks.count.on_fault=skip "
                          "--set tasks.sum.on_fault=hold --set tasks.add.on_fault=hold --set tasks.loop.on_fault=skip ";
}  // namespace

TEST_SUITE("tools/execution") {
  TEST_CASE("at its WCETs a schedulable graph is what it is without them, digest and all") {
    CHECK(command::run_jarol("check specs/counting.yaml").exit_code == 0);
    const json without = report_of(counting);
    for (const std::string execution : {"wcet", "random --seed 7"}) {
      const json with = report_of(counting + "--execution " + execution);
      CHECK(with["digest"] == without["digest"]);
      CHECK(with["activations"] == without["activations"]);
      CHECK(with["fault_count"] == 0);
      CHECK(with["execution"] == execution.substr(0, execution.find(' ')));
    }
  }

  TEST_CASE("what check refuses stops, at the activation that check names") {
    const std::string slow = "--set tasks.slow.wcet=16ms ";
    CHECK(command::run_jarol("check specs/counting.yaml " + slow).exit_code == 1);
    const json run = report_of(counting + slow + "--execution wcet", 3);
    REQUIRE(run["faults"].size() == 1);
    CHECK(run["faults"][0] == json::parse(R"({"task": "slow", "activation": 0, "instant_ns": 15000000,
                                             "cause": "late: ended 16.05ms after its release, deadline 15ms"})"));
  }

  TEST_CASE("faults by a file of times are the same each time, are recorded, and replayed") {
    const TemporaryFolder folder;
    const std::string times = folder.write("times.yaml", "slow: [2ms, 14ms..19ms, 45ms]\ncount: 50us..12ms\n");
    const std::string run = holds + "--seed 3 --execution " + times;
    const json first = report_of(run);
    CHECK(first["fault_count"] > 50);
    const json again = report_of(run + " --record " + (folder / "run.mcap"));
    CHECK(again["digest"] == first["digest"]);
    CHECK(again["faults"] == first["faults"]);
    for (const std::string workers : {"2", "4"})
      CHECK(report_of(run + " --workers " + workers)["digest"] == first["digest"]);
    CHECK(report_of(holds + "--seed 4 --execution " + times)["digest"] != first["digest"]);
    const command::Result replay = command::run_jarol("replay " + (folder / "run.mcap") + " --json", "2>/dev/null");
    const json replayed = json::parse(replay.output);
    CHECK(replayed["digest"] == first["digest"]);
    CHECK(replayed["verdict"] == "same");
    CHECK(command::json_report("log info " + folder / "run.mcap")["execution"] == times);
    CHECK(command::has(command::run_jarol("log info " + folder / "run.mcap").output, "  execution   " + times + "\n"));
    const std::string repeated = command::repeated_by(folder / "run.mcap");
    CHECK(repeated.ends_with(" --seed 3 --for 3s --execution " + times));
    CHECK(command::json_report(repeated)["digest"] == first["digest"]);
    CHECK(replayed["fault_count"] == first["fault_count"]);
  }

  TEST_CASE("a run that is late goes on from what was saved as in one piece, with the same times alone") {
    const TemporaryFolder folder;
    const std::string times = folder.write("times.yaml", "slow: [2ms, 14ms..19ms, 45ms]\ncount: 50us..12ms\n");
    const std::string saved = folder / "saved";
    const json whole = report_of(holds + "--seed 3 --execution " + times);
    for (const std::string at : {"0s", "15ms", "1234ms", "2999ms"}) {
      CAPTURE(at);
      CHECK(report_of(holds + "--seed 3 --execution " + times + " --save " + at + "=" + saved)["digest"] ==
            whole["digest"]);
      const json rest = report_of(counting + "--resume " + saved + " --execution " + times);
      CHECK(rest["digest"] == whole["digest"]);
      CHECK(rest["fault_count"] == whole["fault_count"]);
      std::filesystem::remove(saved);
    }
    report_of(holds + "--seed 3 --execution " + times + " --save 1s=" + saved);
    const std::string resume = counting + "--resume " + saved, other = folder.write("other.yaml", "slow: 2ms\n");
    const std::string wrong = "error: '" + saved + "' is of a run with other execution times: --execution FILE\n";
    CHECK(error_of(resume) == wrong);
    CHECK(error_of(resume + " --execution wcet") == wrong);
    CHECK(error_of(resume + " --execution " + other) == wrong);
    std::filesystem::remove(saved);
    report_of(counting + "--save 1s=" + saved);
    CHECK(error_of(resume + " --execution wcet") == "error: '" + saved + "' is of a run without --execution\n");
  }

  TEST_CASE("a what-if has the execution times of its run") {
    const TemporaryFolder folder;
    const std::string times = folder.write("times.yaml", "count: [1ms, 9ms, 12ms]\nrecent: 2ms..4ms\n");
    const std::string graph = folder.write("graph.yaml", R"(graph: g
timing: {period: 10ms}
fault_limit: 100%
tasks:
  count: {type: Counter, wcet: 1ms, on_fault: hold}
  recent: {type: Window, wcet: 2ms, on_fault: skip, parameters: {length: 3}}
connections: [count.out -> recent.in]
)");
    const json run =
        report_of(graph + " --for 3s --execution " + times + " --what-if 'at=1s set=tasks.recent.parameters.length=3'");
    REQUIRE(run["what_if"].size() == 1);
    CHECK(run["what_if"][0]["digest"] == run["digest"]);
    CHECK(run["what_if"][0]["fault_count"] == run["fault_count"]);
    CHECK(run["fault_count"] > 50);
  }

  TEST_CASE("the report says by what") {
    const command::Result result = command::run_jarol("run " + counting + "--execution random");
    CHECK(result.output.find("  execution   random, by table on one core\n") != std::string::npos);
  }

  TEST_CASE("what can't be is refused with the reason") {
    const TemporaryFolder folder;
    const std::string wrong = folder.write("times.yaml", "slo: 3ms\ncount: soon\n");
    CHECK(error_of(counting + "--execution " + wrong)
              .find(wrong + ":1:1: error: there is no task 'slo'; did you mean "
                            "'slow'?; there are: add, count, loop, slow, sum") == 0);
    CHECK(error_of(counting + "--set tasks.sum.wcet=null --execution wcet") ==
          "error: --execution: task 'sum' has no 'wcet', by which tasks are given to cores\n");
    CHECK(error_of(counting + "--execution wcet --clock real") ==
          "error: --execution belongs to the virtual clock; on the real one tasks take their time\n");
  }
}
