// jarol check as people use it: verdicts, reasons, margins, and how it exits.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::json_of;

using command::Result;
using command::run_jarol;
using command::TemporaryFolder;

}  // namespace

TEST_SUITE("tools/check") {
  TEST_CASE("check says what is schedulable and exits by the verdict") {
    CHECK(run_jarol("check specs/counting.yaml").exit_code == 0);
    const Result no = run_jarol("check specs/counting.yaml --set tasks.slow.wcet=19ms");
    CHECK(no.exit_code == 1);
    CHECK(no.output.starts_with(
        "specs/counting.yaml: NOT SCHEDULABLE core 0: task 'slow' activation 0 (released 0.000 ms) "
        "finishes 19.050 ms, deadline 15.000 ms (late 4.050 ms)\n"));
  }

  TEST_CASE("check --json gives one object per file and line") {
    const Result result = run_jarol("check --json specs/counting.yaml");
    const auto check = nlohmann::json::parse(result.output);
    CHECK(check["schema"] == "jarol.check/2");
    CHECK(check["file"] == "specs/counting.yaml");
    CHECK(check["verdict"] == "schedulable");
    CHECK(check["tasks"][0] == nlohmann::json{{"name", "add"},
                                              {"period_ns", 20'000'000},
                                              {"offset_ns", 10'000'000},
                                              {"deadline_ns", 10'000'000},
                                              {"wcet_ns", 50'000},
                                              {"core", 0},
                                              {"response_ns", 100'000},
                                              {"response_exact", true},
                                              {"slack_ns", 9'900'000},
                                              {"max_wcet_ns", 9'850'000},
                                              {"min_deadline_ns", 100'000}});
    CHECK(check["evidence"] == "proof");
    CHECK(check["witness"] == nullptr);
    CHECK(check["alpha"] == doctest::Approx(6.153845));
    CHECK(check["chains"] == nlohmann::json::array());
    CHECK(check["utilisation"] == doctest::Approx(0.1325));
  }

  TEST_CASE("check --json reports the platform and what is assumed of it") {
    const auto check = json_of("check --json specs/counting.yaml");
    CHECK(check["cores"] == 1);
    CHECK(check["policy"] == "table");
    CHECK(check["assumptions"] ==
          nlohmann::json{{"text", "tasks run one after the other as released, never interrupted, without overhead"},
                         {"phasing", "given"},
                         {"dispatch_ns", 0},
                         {"copy_ns_per_byte", 0}});
    const auto other = json_of(
        "check --json specs/counting.yaml --set 'platform={cores: 2, policy: edf, phasing: any, dispatch: 1us, copy: "
        "2ns}'");
    CHECK(other["cores"] == 2);
    CHECK(other["policy"] == "edf");
    CHECK(other["assumptions"] ==
          nlohmann::json{{"text",
                          "the task with the earliest deadline runs, interrupting others; 'run' does not execute this, "
                          "with 1us for each activation and 2ns for each byte handed on; whatever the offsets"},
                         {"phasing", "any"},
                         {"dispatch_ns", 1000},
                         {"copy_ns_per_byte", 2}});
  }

  TEST_CASE("where tasks belong to no core, their utilisation is told of all cores together") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: global_edf, cores: 2, phasing: any}
tasks:
  a: {type: Work, period: 10ms, wcet: 10ms}
  b: {type: Work, period: 10ms, wcet: 5ms}
  c: {type: Work, period: 10ms, wcet: 5ms}
)");
    const Result bound = run_jarol("check " + file);
    CHECK(bound.exit_code == 3);
    CHECK(bound.output ==
          file +
              R"(: UNKNOWN on 2 cores (global_edf): the tests of global_edf are sufficient only, and none of them holds
  task     period     offset   deadline       wcet     use   response      slack  core
  a          10ms        0ns       10ms       10ms  100.00%          -          -     -
  b          10ms        0ns       10ms        5ms  50.00%          -          -     -
  c          10ms        0ns       10ms        5ms  50.00%          -          -     -
  all 2 cores: utilisation 200.00% of 200%
  utilisation 200.00%; a task's response is its longest time from arrival to end;
  assumed: the earliest deadlines run, on any core; 'run' does not execute this, without overhead; whatever the offsets
  all WCETs together may be 0.666666 times as long; alone, 'a' has least room: up to 5ms
  it would hold with 'policy: fixed_priority'
                  or 'cores: 3'
                  or a 'wcet' of 5ms for 'a', which has 10ms
                  or 'policy: edf', which 'run' does not execute
)");
    // with offsets that hold it is decided
    const Result given = run_jarol("check " + file + " --set platform.phasing=given");
    CHECK(given.exit_code == 0);
    CHECK(given.output.starts_with(file + ": SCHEDULABLE on 2 cores (global_edf), proof: every activation of the whole "
                                          "repetition ends by its deadline, where "
                                          "those of equal deadlines go in order of name\n"));
    const Result late = run_jarol("check " + file + " --set tasks.a.period=11ms");
    CHECK(late.exit_code == 1);
    CHECK(late.output.starts_with(file +
                                  ": NOT SCHEDULABLE task 'a' activation 0 (released 0.000 ms) finishes 15.000 ms, "
                                  "deadline 11.000 ms (late 4.000 ms)\n"));
    CHECK(run_jarol("check " + file + " --set platform.policy=edf").output.find("all 2 cores") == std::string::npos);
    // on one core it is edf, which is decided
    const std::string one = file + " --set platform.cores=1 --set tasks.a.wcet=1ms --set tasks.b.wcet=4ms";
    CHECK(run_jarol("check " + one).exit_code == 0);
    CHECK(run_jarol("check " + one + " --set tasks.c.wcet=5000001ns").exit_code == 1);
    CHECK(json_of("check --json " + one)["policy"] == "global_edf");
  }

  TEST_CASE("check reports why not: the demand, the chart, and what would help") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority}
tasks:
  fast: {type: Work, period: 5ms, wcet: 2ms}
  slow: {type: Work, period: 7ms, wcet: 4ms}
)");
    const Result no = run_jarol("check " + file);
    CHECK(no.exit_code == 1);
    CHECK(
        no.output ==
        file +
            R"(: NOT SCHEDULABLE core 0: task 'slow' activation 0 (released 0.000 ms) finishes 8.000 ms, deadline 7.000 ms (late 1.000 ms)
  proof: a task's worst response is longer than its deadline on one core (fixed_priority)
  from release to end 8ms: fast 4ms + slow 4ms
    fast ##################...........................##################.........
    slow ^.................###########################..................|!!!!!!!!
         0ns                                                                  8ms
  task     period     offset   deadline       wcet     use   response      slack
  fast        5ms        0ns        5ms        2ms  40.00%        2ms        3ms
  slow        7ms        0ns        7ms        4ms  57.14%        8ms       -1ms
  utilisation 97.14%; a task's response is its longest time from arrival to end;
  assumed: the most urgent task runs, interrupting others, as under 'run --clock real', without overhead
  all WCETs together may be 0.875 times as long; alone, 'fast' has least room: up to 1.5ms
  it would hold with 'policy: table'
                  or 'cores: 2'
                  or a 'wcet' of 1.5ms for 'fast', which has 2ms
                  or a 'wcet' of 3ms for 'slow', which has 4ms
                  or 'policy: edf', which 'run' does not execute
)");
    CHECK(run_jarol("check " + file + " --set platform.policy=edf").exit_code == 0);
    const auto late = json_of("check --json --set platform.policy=edf --set tasks.slow.deadline=5ms " + file);
    CHECK(late["witness"] ==
          nlohmann::json{{"core", 0},
                         {"task", "slow"},
                         {"activation", 0},
                         {"release_ns", 0},
                         {"finish_ns", 6'000'000},
                         {"deadline_ns", 5'000'000},
                         {"demand", {{"length_ns", 5'000'000}, {"demand_ns", 6'000'000}, {"blocking_ns", 0}}}});
  }

  TEST_CASE("late by little is reported in what fits, and no digit that matters is left out") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", "{graph: t, tasks: {a: {type: Work, period: 50ms, let: 40ms}}}\n");
    const auto headline = [&](const std::string& wcet) {
      const std::string output = run_jarol("check " + file + " --set tasks.a.wcet=" + wcet).output;
      return output.substr(0, output.find('\n'));
    };
    const std::string late = file + ": NOT SCHEDULABLE core 0: task 'a' activation 0 (released 0.000 ms) finishes ";
    CHECK(headline("40000001ns") == late + "40.000001 ms, deadline 40.000 ms (late 1 ns)");
    CHECK(headline("40000999ns") == late + "40.000999 ms, deadline 40.000 ms (late 999 ns)");
    CHECK(headline("40001us") == late + "40.001 ms, deadline 40.000 ms (late 0.001 ms)");
    CHECK(headline("40012345ns") == late + "40.012345 ms, deadline 40.000 ms (late 12.345 us)");
    CHECK(headline("41000001ns") == late + "41.000001 ms, deadline 40.000 ms (late 1.000001 ms)");
    CHECK(headline("60350us") ==
          file +
              ": NOT SCHEDULABLE utilisation 120.70% of one core: there is more to do than time; core 0: task 'a' "
              "activation 0 (released 0.000 ms) finishes 60.350 ms, deadline 40.000 ms (late 20.350 ms)");
  }

  TEST_CASE("where only jitter makes a task late, the worst response is reported") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority, phasing: any}
tasks:
  a: {type: Work, period: 5ms, wcet: 2ms, jitter: 3ms}
  b: {type: Work, period: 10ms, wcet: 3ms, deadline: 6ms}
)");
    const Result late = run_jarol("check " + file);
    CHECK(late.exit_code == 1);
    CHECK(late.output.starts_with(
        file +
        ": NOT SCHEDULABLE core 0: task 'b' responds within 7.000 ms at worst, deadline 6.000 ms (late 1.000 ms)\n"));
  }

  TEST_CASE("overheads of the platform count in the verdict, and margins leave them out") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: edf}
timing: {period: 10ms}
tasks:
  a: {type: Counter, wcet: 4ms}
  b: {type: Relay, wcet: 4ms}
connections: [a.out -> b.in]
)");
    CHECK(json_of("check --json " + file)["alpha"] == doctest::Approx(1.25));
    const auto with = json_of("check --json --set platform.dispatch=1ms --set platform.copy=1us " + file);
    CHECK(with["verdict"] == "not_schedulable");  // 8 bytes: 8 us over
    CHECK(with["tasks"][0]["max_wcet_ns"] == 3'992'000);
    CHECK(with["alpha"] == doctest::Approx(7.992 / 8));
  }

  TEST_CASE("check draws who runs when, and the chart of a late activation") {
    const TemporaryFolder folder;
    const auto text_of = [](const std::string& path) {
      std::ifstream file(path);
      return std::string{std::istreambuf_iterator<char>(file), {}};
    };
    CHECK(run_jarol("check specs/counting.yaml --svg " + (folder / "good.svg")).exit_code == 0);
    const std::string good = text_of(folder / "good.svg");
    CHECK(good.find(">counting: the first 110ms, each task as long as its wcet</text>") != std::string::npos);
    const auto to_stdout = run_jarol("check specs/counting.yaml --svg -", "2>/dev/null");
    CHECK(to_stdout.output == good);  // what it says goes to stderr
    CHECK(run_jarol("check specs/counting.yaml --set tasks.slow.wcet=20ms --svg " + (folder / "g.svg")).exit_code == 1);
    const std::string svg = text_of(folder / "g.svg");
    CHECK(svg.starts_with("<svg xmlns"));
    CHECK(svg.find("counting: activation 0 of slow is 5.05ms late</text>") != std::string::npos);
    CHECK(svg.ends_with("</svg>\n"));
  }

  TEST_CASE("check writes random graphs that it can check, the same for the same seed") {
    const TemporaryFolder folder;
    CHECK(run_jarol("check --generate waters --count 2 --seed 7 -o " + (folder / "g")).output ==
          "2 graphs in " + (folder / "g") + "\n");
    CHECK(run_jarol("check --generate waters --seed 7 -o " + (folder / "h")).exit_code == 0);
    const auto text_of = [](const std::string& path) {
      std::ifstream file(path);
      return std::string{std::istreambuf_iterator<char>(file), {}};
    };
    CHECK(text_of(folder / "g/waters_7.yaml") == text_of(folder / "h/waters_7.yaml"));
    CHECK(text_of(folder / "g/waters_7.yaml") != text_of(folder / "g/waters_8.yaml"));
    for (const std::string kind : {"waters", "uunifast"}) {
      run_jarol("check --generate " + kind + " --tasks 12 --utilisation 0.5 -o " + (folder / "k"));
      const auto check = json_of("check --json " + (folder / "k") + "/" + kind + "_0.yaml");
      CHECK(check["tasks"].size() == 12);
      CHECK(check["utilisation"] == doctest::Approx(0.5).scale(0).epsilon(0.001));
    }
    CHECK(run_jarol("check --generate waters").output == "error: --generate needs -o DIR, a folder for the graphs\n");
    CHECK(run_jarol("check").output == "error: check needs a FILE, a graph\n");
  }

  TEST_CASE("without a wcet the verdict is open") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", "{graph: t, tasks: {a: {type: Counter, period: 1ms}}}\n");
    const Result result = run_jarol("check " + file);
    CHECK(result.exit_code == 3);
    CHECK(result.output.starts_with(file + ": UNKNOWN on one core (table): no 'wcet' is stated for 'a'\n"));
  }

  TEST_CASE("a bad file does not hide the others, and all its errors are reported") {
    const TemporaryFolder folder;
    const std::string bad =
        folder.write("bad.yaml", "{graph: t, tasks: {a: {type: Countr, period: 1ms}}, conections: []}\n");
    const Result result = run_jarol("check --json " + bad + " specs/counting.yaml", "2>/dev/null");
    CHECK(result.exit_code == 2);
    const std::size_t second = result.output.find('\n') + 1;
    const auto problems = nlohmann::json::parse(result.output.substr(0, second));
    CHECK(problems["schema"] == "jarol.problems/1");
    CHECK(problems["file"] == bad);
    CHECK(problems["problems"].size() == 2);
    CHECK(nlohmann::json::parse(result.output.substr(second))["file"] == "specs/counting.yaml");
    CHECK(run_jarol("check " + bad).output.ends_with(bad + ": 2 errors\n"));
  }

  TEST_CASE("many files are reported in their order, each as it is by itself, however long each takes") {
    const TemporaryFolder folder;
    const std::string bad = folder.write("bad.yaml", "{graph: t, tasks: {a: {type: Countr, period: 1ms}}}\n");
    REQUIRE(run_jarol("check --generate uunifast --count 24 --tasks 40 -o " + (folder / "made")).exit_code == 0);
    std::string files, reports;
    for (int i = 0; i < 24; ++i) {
      // the long ones first, and one that is wrong between
      const std::string file = i == 7       ? bad
                               : i % 8 == 5 ? "specs/counting.yaml"
                                            : folder / "made/uunifast_" + std::to_string(i) + ".yaml";
      files += " " + file;
      reports += run_jarol("check " + file).output;
    }
    const Result all = run_jarol("check" + files);
    CHECK(all.exit_code == 2);
    CHECK((all.output == reports));
    const std::string json = run_jarol("check --json" + files, "2>/dev/null").output;
    CHECK(std::count(json.begin(), json.end(), '\n') == 24);
  }
}
