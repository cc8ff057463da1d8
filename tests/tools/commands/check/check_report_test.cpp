// What the report of a check says of responses, of what is late, and of cores that are too full.
#include "tools/commands/check/check_report.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::json_of;
using command::run_jarol;
using command::TemporaryFolder;
}  // namespace

TEST_SUITE("tools/check_report") {
  TEST_CASE("where no time line is drawn, how long a late task takes stands alone") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority_nonpreemptive}
tasks:
  a: {type: Counter, period: 10ms, wcet: 2ms, jitter: 25ms}
  b: {type: Counter, period: 50ms, wcet: 30ms}
)");
    const auto no = run_jarol("check " + file);
    CHECK(no.exit_code == 1);
    CHECK(no.output.find("\n  from release to end 32ms\n") != std::string::npos);
  }

  TEST_CASE("a response is the longest there is, or said to be no more than a bound") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: edf}
tasks:
  a: {type: Work, period: 10ms, wcet: 2ms, deadline: 3ms}
  b: {type: Work, period: 10ms, offset: 5ms, wcet: 2ms, deadline: 3ms}
  c: {type: Work, period: 10ms, offset: 5ms, wcet: 2ms, deadline: 3ms}
)");
    const std::string exact = run_jarol("check " + file).output;
    CHECK(exact.find(R"(
  task     period     offset   deadline       wcet     use   response      slack
  a          10ms        0ns        3ms        2ms  20.00%        2ms        1ms
  b          10ms        5ms        3ms        2ms  20.00%        2ms        1ms
  c          10ms        5ms        3ms        2ms  20.00%        4ms       -1ms
  utilisation 60.00%; a task's response is its longest time from arrival to end;
)") != std::string::npos);
    const std::string bounds = run_jarol("check " + file + " --set platform.phasing=any").output;
    CHECK(bounds.find(R"(
  a          10ms        0ns        3ms        2ms  20.00%      <=6ms     >=-3ms
  b          10ms        5ms        3ms        2ms  20.00%      <=6ms     >=-3ms
  c          10ms        5ms        3ms        2ms  20.00%      <=6ms     >=-3ms
  utilisation 60.00%; a task's response is its longest time from arrival to end; after '<=' it is no longer than that, and may be shorter;
)") != std::string::npos);
    const auto task = [&](const std::string& set) { return json_of("check --json " + file + set)["tasks"][2]; };
    CHECK(task("")["response_ns"] == 4'000'000);
    CHECK(task("")["response_exact"] == true);
    CHECK(task(" --set platform.phasing=any")["response_ns"] == 6'000'000);
    CHECK(task(" --set platform.phasing=any")["response_exact"] == false);
    CHECK(task(" --set platform.policy=edf_nonpreemptive")["response_exact"] == false);
    CHECK(task(" --set tasks.a.wcet=11ms")["response_exact"].is_null());
    // not interrupting, where an earlier end lets another go first
    const std::string safe = " --set platform.policy=edf_nonpreemptive --set tasks.c.deadline=10ms";
    CHECK(task(safe)["response_ns"] == 4'000'000);
    CHECK(task(safe)["response_exact"] == true);
  }

  TEST_CASE("more work than time on the core that tasks state is the headline") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {cores: 2}
tasks:
  a: {type: Work, period: 10ms, wcet: 6ms, core: 1}
  b: {type: Work, period: 10ms, wcet: 6ms, core: 1}
  c: {type: Work, period: 10ms, wcet: 1ms}
)");
    const std::string headline =
        file + ": NOT SCHEDULABLE utilisation 120.00% of core 1: there is more to do than time; core 1: task 'b' ";
    for (const std::string policy : {"table", "fixed_priority", "edf", "edf_nonpreemptive"})
      CHECK(run_jarol("check " + file + " --set platform.policy=" + policy).output.starts_with(headline));
    CHECK(run_jarol("check " + file + " --set tasks.c.wcet=9ms")
              .output.find("utilisation 210.00% of 2 cores: there is "
                           "more to do than time;") != std::string::npos);
    CHECK(run_jarol("check " + file + " --set platform.policy=global_edf").exit_code == 0);
  }

  TEST_CASE("a deadline or latency that is a difference of offsets is not judged where the offsets are open") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority, phasing: any}
tasks:
  a: {type: Counter, period: 10ms, wcet: 6ms}
  b: {type: Relay, period: 10ms, offset: 9ms, let: 10ms, wcet: 1ms}
connections: [a.out -> b.in]
)");
    const auto open = run_jarol("check " + file);
    CHECK(open.exit_code == 3);
    CHECK(open.output.starts_with(file +
                                  ": UNKNOWN on one core (fixed_priority): the deadline of 'a' follows from when "
                                  "'b' reads, and 'phasing: any' leaves that open; give 'a' a 'let', or state "
                                  "'phasing: given'\n"));
    CHECK(json_of("check --json " + file)["evidence"] == "none");
    CHECK(run_jarol("check " + file + " --set platform.phasing=given").exit_code == 0);
    CHECK(run_jarol("check " + file + " --set tasks.a.let=10ms").exit_code == 0);
    // who follows at the same instant does so whatever others do
    CHECK(run_jarol("check " + file + " --set tasks.b.offset=0ms").exit_code == 0);

    const std::string chain = folder.write("c.yaml", R"(graph: c
platform: {policy: fixed_priority, phasing: any}
tasks:
  a: {type: Counter, period: 10ms, let: 1ms, wcet: 100us}
  b: {type: Relay, period: 10ms, offset: 1ms, let: 1ms, wcet: 100us}
connections: [a.out -> b.in]
chains: {x: {path: [a, b], reaction: 12ms}}
)");
    CHECK(run_jarol("check " + chain + " --set platform.phasing=given").exit_code == 0);
    const auto any = run_jarol("check " + chain);
    CHECK(any.exit_code == 3);
    CHECK(any.output.find("  chain x: reaction - to 22ms, data age at most 22ms, jitter - (upper bounds)\n"
                          "    LIMIT MAY BE BROKEN, by upper bounds: reaction 22ms over 12ms\n") != std::string::npos);
    CHECK(any.output.starts_with(chain + ": SCHEDULABLE on one core (fixed_priority), "));
    CHECK(any.output.find(", BUT A LIMIT MAY BE BROKEN by chain 'x': ") != std::string::npos);
    const auto judged = json_of("check --json " + chain);
    CHECK(judged["limits_hold"].is_null());
    CHECK(judged["chains"][0]["exact"] == false);
    for (const char* unknown : {"holds", "jitter_ns", "min_reaction_ns"}) CHECK(judged["chains"][0][unknown].is_null());
  }

  TEST_CASE("what the platform adds counts in the use of tasks and cores, and cores that a policy leaves are named") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority, cores: 2, dispatch: 4us}
tasks:
  a: {type: Counter, period: 10us, let: 10us, wcet: 2us, core: 0}
  b: {type: Counter, period: 10us, let: 10us, wcet: 1us, core: 0}
)");
    const std::string no = run_jarol("check " + file).output;
    CHECK(no.find("        2us  60.00%  ") != std::string::npos);
    CHECK(no.find("\n  core 0: utilisation 110.00%, idle -10.00%\n  core 1: utilisation 0.00%, idle 100.00%\n") !=
          std::string::npos);
    CHECK(
        run_jarol("check " + file + " --set platform.policy=global_edf --set platform.dispatch=1us")
            .output.find("on any core; 'run' does not execute this, with 1us for each activation and 0ns for each byte "
                         "handed on; 'core' is ignored\n") != std::string::npos);
  }

  TEST_CASE("the factor by which all WCETs may grow is one that holds as it is printed") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", "graph: t\ntasks: {a: {type: Counter, period: 10us, wcet: 6us}}\n");
    CHECK(run_jarol("check " + file).output.find("  all WCETs together may be 1.66666 times as long;") !=
          std::string::npos);
    CHECK(run_jarol("check " + file + " --set tasks.a.wcet=2us").output.find(" may be 5 times as long;") !=
          std::string::npos);
  }

  TEST_CASE("a graph that comes by standard input gets its picture on standard output") {
    const auto drawn = run_jarol("check - --svg - < specs/counting.yaml");
    CHECK(drawn.exit_code == 0);
    CHECK(drawn.output.find("<svg xmlns=") != std::string::npos);
  }

  TEST_CASE("a least deadline that puts its task before another in the table is stated only where both hold then") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
tasks:
  a: {type: Counter, period: 40us, wcet: 23us}
  b: {type: Counter, period: 40us, let: 40us, wcet: 5us, jitter: 14us}
)");
    const auto min_deadline = [&](const std::string& set) {
      return json_of("check --json --sensitivity " + file + set)["tasks"][1]["min_deadline_ns"];
    };
    CHECK(min_deadline("").is_null());
    CHECK(run_jarol("check " + file + " --set tasks.b.deadline=28us").exit_code == 1);
    CHECK(min_deadline(" --set tasks.b.jitter=10us") == 28'000);
    CHECK(run_jarol("check " + file + " --set tasks.b.jitter=10us --set tasks.b.deadline=28us").exit_code == 0);
  }

  TEST_CASE("of a late task that never ends the report says by when it has not, and JSON has no end of it") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority}
tasks:
  a: {type: Counter, period: 10ms, wcet: 10ms}
  b: {type: Counter, period: 10ms, wcet: 1ms}
)");
    const std::string text = run_jarol("check " + file).output;
    CHECK(text.starts_with(file +
                           ": NOT SCHEDULABLE utilisation 110.00% of one core: there is more to do than time; core 0: "
                           "task 'b' activation 0 (released 0.000 ms) has not finished by 100020.000 ms, deadline "
                           "10.000 ms (late more than 100010.000 ms)\n"));
    CHECK(text.find("\n  from release to there 100.02s, of which the last 2.02s: a 2.02s\n") != std::string::npos);
    const auto witness = json_of("check --json " + file)["witness"];
    CHECK(witness["finish_ns"] == nullptr);
    CHECK(witness["unfinished_ns"] == 100'020'000'000);
    CHECK(witness["deadline_ns"] == 10'000'000);
    command::run_jarol("check " + file + " --svg " + file + ".svg");
    CHECK(command::content(file + ".svg").find(">t: activation 0 of b is more than 100.01s late<") !=
          std::string::npos);
  }

  TEST_CASE("the parts of the work that is due have what the platform adds, and sum up to all of it") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: edf, dispatch: 1ms}
tasks:
  a: {type: Counter, period: 10ms, let: 10ms, wcet: 5ms}
  b: {type: Counter, period: 15ms, let: 10ms, wcet: 4ms}
)");
    CHECK(
        run_jarol("check " + file).output.find("\n  in an interval of 10ms work of 11ms is due: a 1x6ms + b 1x5ms\n") !=
        std::string::npos);
  }

  TEST_CASE("where only the last pieces of a long wait are kept, the report and its chart are of these") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority}
tasks:
  hp: {type: Counter, period: 1ms, let: 1ms, wcet: 900us}
  lp: {type: Counter, period: 2s, let: 1s, wcet: 150ms}
)");
    const std::string text = run_jarol("check " + file).output;
    CHECK(text.find("\n  from release to end 1.5s, of which the last 200ms: hp 180ms + lp 20ms\n    hp ####") !=
          std::string::npos);
    CHECK(text.find("\n       1.3s                                                                1.5s\n") !=
          std::string::npos);
    run_jarol("check " + file + " --svg " + file + ".svg");
    CHECK(command::content(file + ".svg").find(">released ") == std::string::npos);
  }

  TEST_CASE("what was not kept, as other cores were busy, is no time of waiting") {
    const TemporaryFolder folder;
    const std::string table = folder.write("t.yaml", R"(graph: t
platform: {cores: 2}
tasks:
  b: {type: Counter, period: 2s, let: 2s, wcet: 900ms, core: 0}
  l: {type: Counter, period: 2s, offset: 500ms, let: 500ms, wcet: 200ms, core: 0}
  x: {type: Counter, period: 1ms, let: 1ms, wcet: 500us, core: 1}
)"),
                      by_priority = folder.write("p.yaml", R"(graph: t
platform: {policy: fixed_priority, cores: 4}
tasks:
  p: {type: Counter, period: 1s, wcet: 300ms, core: 1}
  h: {type: Counter, period: 10ms, wcet: 5ms, core: 0, deadline: 10ms}
  l: {type: Relay, period: 1s, wcet: 450ms, core: 0}
  x: {type: Counter, period: 1ms, wcet: 500us, core: 2}
  y: {type: Counter, period: 1ms, wcet: 500us, core: 3}
connections: [p.out -> l.in]
)");
    CHECK(
        run_jarol("check " + table).output.find("\n  from release to end 600ms, of which the last 200ms: l 200ms\n") !=
        std::string::npos);
    CHECK(run_jarol("check " + by_priority)
              .output.find("\n  from release to end 1.2s, of which the last 275ms: h 135ms + l 140ms\n") !=
          std::string::npos);
  }

  TEST_CASE("what a late task of a table waits for on another core is named, and blocking is no running") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {cores: 2}
tasks:
  p: {type: Counter, period: 10ms, wcet: 8ms, core: 0}
  r: {type: Relay, period: 10ms, let: 10ms, wcet: 3ms, blocking: 1ms, core: 1}
connections: [p.out -> r.in]
)");
    CHECK(run_jarol("check " + file)
              .output.find("\n  from release to end 12ms: r 3ms + blocking 1ms + waiting for 'p' 8ms\n") !=
          std::string::npos);
  }
}
