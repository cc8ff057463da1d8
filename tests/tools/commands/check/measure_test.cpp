// In one file: all cases measure the same tasks.
#include "distributers/session/measure.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "graph/language/quantities.h"
#include "graph/model/with_wcets.h"
#include "graph/text/errors.h"
#include "tests/graph/graph_of.h"
#include "tests/tools/run_command.h"
#include "tools/commands/run/load_graph.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

using command::content;
using command::TemporaryFolder;

// One task each: without a WCET, with one that is too short, with one that is long, one that is not released soon, and
// one with less than a disturbance takes.
const std::string file_text = R"(graph: t
tasks:
  fresh: {type: Counter, period: 100ms}
  long:  {type: Counter, period: 100ms, wcet: 40ms}
  short: {type: Work, period: 100ms, wcet: 1ns}
  late:  {type: Counter, period: 10s, offset: 5s, wcet: 1ms}
  tight: {type: Counter, period: 100ms, wcet: 90us}
)";

std::string rewritten(const std::string& text, const std::vector<std::optional<Duration>>& wcets) {
  Problems problems;
  const auto source = std::make_shared<Source>(Source{"t.yaml", text});
  const GraphSpec spec = load_spec(source, {}, problems);
  problems.throw_if_any();
  return with_wcets(text, spec, tests::graph_of(text), wcets);
}
}  // namespace

TEST_SUITE("tools/measure") {
  TEST_CASE("a margin comes on top, rounded up to three digits") {
    CHECK(with_margin(1000ns, 0.2) == 1200ns);
    CHECK(with_margin(12'345ns, 0) == 12'400ns);
    CHECK(with_margin(999ns, 0) == 999ns);
    CHECK(with_margin(0ns, 0.2) == 1ns);
  }

  TEST_CASE("WCETs are written into a file, and its comments and layout stay") {
    CHECK(rewritten(R"(graph: t  # a comment
timing: {period: 10ms}
tasks:
  b: {type: Relay, let: 5ms, wcet: 1ms}   # keep me
  a: { type: Counter }

  c:
    # above
    type: Counter   # behind
    period: 5ms
  d:
    wcet: '3ms'
    type: Counter
connections: [a.out -> b.in]
)",
                    {1us, 2us, 3500ns, 4us}) == R"(graph: t  # a comment
timing: {period: 10ms}
tasks:
  b: {type: Relay, let: 5ms, wcet: 2us}   # keep me
  a: { type: Counter, wcet: 1us }

  c:
    # above
    type: Counter
    wcet: 3.5us   # behind
    period: 5ms
  d:
    wcet: '4us'
    type: Counter
connections: [a.out -> b.in]
)");
  }

  TEST_CASE("JSON stays JSON, lines end as the others do, and a block of lines is refused") {
    CHECK(rewritten(R"({"graph": "t", "tasks": {"a": {"type": "Counter", "period": "1ms"},
"b": {"type": "Counter",
"period": "1ms"}, "c": {
  "type": "Counter"
,"period": "1ms", "wcet": "1ns"}}})",
                    {462ns, 2us, 3us}) ==
          R"({"graph": "t", "tasks": {"a": {"type": "Counter", "wcet": "462ns", "period": "1ms"},
"b": {"type": "Counter", "wcet": "2us",
"period": "1ms"}, "c": {
  "type": "Counter"
,"period": "1ms", "wcet": "3us"}}})");
    CHECK(rewritten("graph: t\ntasks:\n  a: {\n    type: Counter,\n    period: 1ms}\n", {1us}) ==
          "graph: t\ntasks:\n  a: {\n    type: Counter, wcet: 1us,\n    period: 1ms}\n");
    CHECK(rewritten("graph: t\r\ntasks:\r\n  a:\r\n    type: Counter\r\n    period: 1ms\r\n", {1us}) ==
          "graph: t\r\ntasks:\r\n  a:\r\n    type: Counter\r\n    wcet: 1us\r\n    period: 1ms\r\n");
    CHECK_THROWS_WITH_AS(
        rewritten("graph: t\ntasks:\n  a:\n    type: Counter\n    period: 1ms\n    wcet: >-\n      1ns\n", {1us}),
        "the 'wcet' of task 'a' is a block of lines; write it on the line of its key", InputError);
  }

  TEST_CASE("tasks that share one place of the file are not edited") {
    CHECK_THROWS_WITH_AS(rewritten("graph: t\ntasks:\n  a: &one {type: Counter, period: 1ms}\n  b: *one\n", {1us, 1us}),
                         "two tasks share one place of the file through an alias; write their 'wcet' yourself",
                         InputError);
  }

  TEST_CASE("a task without a new WCET keeps its line") {
    const std::string text = "graph: t\ntasks:\n  a: {type: Counter, period: 1ms}\n  b: {type: Counter, period: 1ms}\n";
    CHECK(rewritten(text, {std::nullopt, std::nullopt}) == text);
    CHECK(rewritten(text, {std::nullopt, 1us}) ==
          "graph: t\ntasks:\n  a: {type: Counter, period: 1ms}\n  b: {type: Counter, wcet: 1us, period: 1ms}\n");
  }

  TEST_CASE("check --write writes what is missing or too short, keeps what is longer, and says so") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", file_text);
    const auto reported = command::run_jarol("check --write --for 1s --margin 50 " + file, "2>&1 >/dev/null").output;
    const auto row = [&](const std::string& task) {
      const std::size_t begin = reported.find("  " + task + " ");
      return reported.substr(begin, reported.find('\n', begin) - begin);
    };
    CHECK(reported.starts_with(file + ": measured over 1s of logical time on this machine, in processor time\n"
                                      "  task   activations     99.9 %        max       wcet    written\n"));
    CHECK(row("late") ==
          "  late             0          -          -        1ms          -  never released in that time");
    CHECK(row("long").ends_with("       40ms       kept"));
    CHECK(row("short").find("        1ns  ") != std::string::npos);
    CHECK(row("short").ends_with("  LONGER THAN ITS WCET"));
    CHECK(reported.ends_with("  written into " + file +
                             ": 99.9 % and the longest disturbance of any task, but no less than 100us, with 50 % on "
                             "top\n"
                             "  a 'wcet' that is no shorter than that was kept; --lower lowers it\n"));
    const Graph graph = tests::graph_of(content(file));
    const auto wcet = [&](const std::string& name) {
      for (const Task& task : graph.tasks)
        if (task.name == name) return task.wcet;
      return std::optional<Duration>{};
    };
    CHECK(wcet("late") == 1ms);
    CHECK(wcet("long") == 40ms);
    // whatever was met, there is room for a disturbance: 100 us and 50 %
    REQUIRE(wcet("fresh").has_value());
    CHECK(wcet("fresh") >= 150us);
    CHECK(wcet("short") >= 150us);
    CHECK(wcet("short") < 40ms);
    CHECK(row("fresh").ends_with("  " + duration_text(*wcet("fresh"))));
  }

  TEST_CASE("--lower leaves room for a disturbance of 100 us, and lowers nothing that has no more") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", file_text);
    const auto wcet = [&](const std::string& name) {
      const Graph graph = tests::graph_of(content(file));
      for (const Task& task : graph.tasks)
        if (task.name == name) return *task.wcet;
      return Duration{};
    };
    const std::string reported = command::run_jarol("check --write --lower --for 1s " + file, "2>&1 >/dev/null").output;
    CHECK(reported.find("\n  a 'wcet' was kept that leaves no more than the margin over a disturbance of 100us\n") !=
          std::string::npos);
    CHECK(wcet("long") >= 120us);  // 100 us and 20 %
    CHECK(wcet("long") < 40ms);
    CHECK(wcet("tight") >= 90us);  // more only if it was measured
    // so that nobody who measures again finds it broken
    const auto again = command::run_jarol("check --measure --for 1s " + file, "2>&1 >/dev/null").output;
    CHECK(again.substr(again.find("  long "), 80).find("LONGER") == std::string::npos);
  }

  TEST_CASE("a task that takes longer than its WCET is said before the verdict, which is negative then") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", file_text);
    const std::string stated = "check " + file + " --set tasks.fresh.wcet=10ms";
    CHECK(command::run_jarol(stated).exit_code == 0);
    const auto measured = command::run_jarol(stated + " --measure --for 1s", "2>/dev/null");
    CHECK(measured.exit_code == 1);
    CHECK(measured.output.starts_with(file + ": A WCET DOES NOT HOLD HERE: task 'short' took "));
    CHECK(measured.output.find(", its 'wcet' is 1ns; with the times as stated:\n" + file + ": SCHEDULABLE ") !=
          std::string::npos);
    const auto json =
        nlohmann::json::parse(command::run_jarol(stated + " --measure --for 1s --json", "2>/dev/null").output);
    CHECK(json["measured"]["over_ns"] == 1'000'000'000);
    CHECK(json["measured"]["wcets_hold"] == false);
    CHECK(json["measured"]["tasks"][3]["name"] == "short");
    CHECK(json["measured"]["tasks"][3]["longer_than_wcet"] == true);
    CHECK(json["measured"]["tasks"][2]["longer_than_wcet"] == false);
    // with times that hold here
    const std::string good = stated + " --set tasks.short.wcet=20ms --set tasks.tight.wcet=20ms --measure --for 1s";
    CHECK(command::run_jarol(good).exit_code == 0);
    CHECK(nlohmann::json::parse(command::run_jarol(good + " --json", "2>/dev/null").output)["measured"]["wcets_hold"] ==
          true);
  }

  TEST_CASE("faults of activations that were measured are said beside their times") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
tasks: {loop: {type: Accumulate, period: 10ms, on_fault: hold, wcet: 40ms}}
connections: [big -> loop.in]
communicators: {big: {type: double, direction: in, period: 10ms, init: 1.5e308}}
)");
    const std::string reported = command::run_jarol("check --measure --for 100ms " + file, "2>&1 >/dev/null").output;
    CHECK(reported.find("\nfault: task 'loop' 9 times, from activation 1 at 0.01 s") != std::string::npos);
    CHECK(reported.ends_with("\n  the times of faulty activations are among those above\n"));
  }

  TEST_CASE("what comes on stdin is measured, and not written") {
    CHECK(command::run_jarol("check - --write < specs/counting.yaml").output ==
          "error: --write: '-' is stdin, which can't be written; name the graph's file\n");
    CHECK(!std::filesystem::exists("-"));
  }

  TEST_CASE("the verdict after check --write is that of the file as it was written") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", file_text);
    const std::string measured = "check --json --write --for 1s --set tasks.long.wcet=200ms " + file;
    const auto verdict = command::run_jarol(measured, "2>/dev/null");
    CHECK(verdict.exit_code == 0);
    CHECK(verdict.output == command::run_jarol("check --json " + file).output);
    CHECK(nlohmann::json::parse(verdict.output)["tasks"][2]["wcet_ns"] == 40'000'000);
    CHECK(command::run_jarol(measured, "2>&1 >/dev/null")
              .output.ends_with("  measured with --set or --profile; what follows is said of the file as it stands, "
                                "without them\n"));
  }

  TEST_CASE("a file that needs nothing is not touched, nor one that can't be edited") {
    const TemporaryFolder folder;
    const std::string text = "graph: t\ntasks: {a: {type: Counter, period: 100ms, wcet: 90ms}}\n";
    const std::string file = folder.write("t.yaml", text);
    const auto before = std::filesystem::last_write_time(file);
    CHECK(
        command::run_jarol("check --write --for 1s " + file).output.find("  nothing is written into " + file + "\n") !=
        std::string::npos);
    CHECK(content(file) == text);
    CHECK(std::filesystem::last_write_time(file) == before);
    const std::string shared = "graph: t\ntasks:\n  a: &one {type: Counter, period: 1ms}\n  b: *one\n";
    folder.write("t.yaml", shared);
    const auto refused = command::run_jarol("check --write --for 1s " + file);
    CAPTURE(refused.output);
    CHECK(refused.exit_code == 2);
    CHECK(refused.output.starts_with(file + ": measured over 1s of logical time"));
    CHECK(refused.output.ends_with(
        "\nerror: two tasks share one place of the file through an alias; write their 'wcet' yourself\n" + file +
        ": 1 error\n"));
    CHECK(content(file) == shared);
  }

  TEST_CASE("a file that can't be measured or written hides neither the others nor what was measured") {
    const TemporaryFolder folder;
    const std::string shared =
        folder.write("s.yaml", "graph: t\ntasks:\n  a: &one {type: Counter, period: 1ms}\n  b: *one\n");
    const std::string good = folder.write("t.yaml", "graph: t\ntasks: {a: {type: Counter, period: 100ms}}\n");
    const auto reported = command::run_jarol("check --write --for 1s " + shared + " specs/missing.yaml " + good);
    CHECK(reported.exit_code == 2);
    CHECK(reported.output.find("\n  b            1000 ") < reported.output.find("\nerror: two tasks share one place"));
    CHECK(reported.output.find("\nerror: can't read 'specs/missing.yaml': No such file or directory\n") !=
          std::string::npos);
    CHECK(reported.output.find("\n" + good + ": SCHEDULABLE on one core") != std::string::npos);
    CHECK(command::run_jarol("check --measure --for 1 " + good + " " + shared).output ==
          "error: --for: '1' has no unit; write one of h, min, s, ms, us or ns, as in 10ms\n");
  }

  TEST_CASE("what is changed in a file while it is measured is not lost") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", "graph: t\ntasks: {a: {type: Counter, period: 1ms}}\n");
    // again where the machine did not let anybody change it meanwhile
    command::Result refused;
    for (int attempt = 0; attempt < 10 && refused.exit_code != 2; ++attempt) {
      folder.write("t.yaml", "graph: t\ntasks: {a: {type: Counter, period: 1ms}}\n");
      refused = command::run_jarol(
          "check --write --for 500s " + file,
          "2>&1 & id=$!; while kill -0 $id 2>&-; do echo '# more' >> " + file + "; sleep 0.01; done; wait $id");
    }
    CHECK(refused.exit_code == 2);
    CHECK(refused.output.starts_with(file + ": measured over 500s of logical time on this machine, in processor time\n"
                                            "  task  activations     99.9 %        max       wcet\n"
                                            "  a "));
    CHECK(refused.output.ends_with("error: '" + file +
                                   "' was changed while it was measured; nothing is written, measure again\n" + file +
                                   ": 1 error\n"));
    CHECK(content(file).starts_with("graph: t\ntasks: {a: {type: Counter, period: 1ms}}\n# more\n"));
  }

  TEST_CASE("tasks that hear from a link to what goes on by itself are not measured") {
    const auto refused = command::run_jarol("check --measure specs/exolauv.yaml --profile dune");
    CHECK(refused.exit_code == 2);
    CHECK(refused.output ==
          "note: distributer 'dune': not fitted, and so not checked: leak2, leak3, hull_temperature, "
          "hull_temperature1, hull_temperature2, hull_temperature3, voltage, current\n"
          "error: distributer 'dune' has a link to what goes on by itself, from which nothing comes while tasks are "
          "measured; choose a link in process, as simulation or script\nspecs/exolauv.yaml: 1 error\n");
  }

  TEST_CASE("every activation of every task is measured") {
    Loaded loaded = tools::load_graph("specs/counting.yaml", {});
    const auto measured = measure_tasks(loaded, 1s).tasks;
    REQUIRE(measured.size() == 5);
    const std::vector<std::size_t> activations{50, 100, 20, 50, 50};
    Duration sum{};
    for (std::size_t i = 0; i < measured.size(); ++i) {
      CHECK(measured[i].activations == activations[i]);
      CHECK(measured[i].max >= measured[i].max_of_999);
      sum += measured[i].max_of_999;
    }
    CHECK(sum > 0ns);  // a task of next to nothing may take no more than reading the clock does
  }
}
