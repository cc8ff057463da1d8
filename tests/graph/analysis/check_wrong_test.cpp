// Graphs that were once judged wrongly (tests/data/check-wrong), each with what is true of it and why.
#include <doctest/doctest.h>

#include "graph/analysis/check.h"
#include "graph/analysis/sensitivity.h"
#include "graph/language/yaml.h"
#include "tests/graph/analysis/milliseconds.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace jarol::analysis;

using tests::ms;

struct Judged {
  Graph graph;
  System system;
  Result result;

  explicit Judged(const std::string& name, const std::string& policy = "", const std::string& other = "")
      : graph(tests::graph_of(text_of(name, policy, other))), system(system_of(graph)), result(check(graph)) {}

  static std::string text_of(const std::string& name, const std::string& policy, const std::string& other) {
    std::string text = read_source("tests/data/check-wrong/" + name + ".yaml")->text;
    if (!policy.empty()) text.replace(text.find(policy), policy.size(), other);
    return text;
  }

  Duration response(const std::string& task) const {
    for (std::size_t i = 0; i < graph.tasks.size(); ++i)
      if (graph.tasks[i].name == task) return result.response[i].value_or(Duration(-1));
    return Duration(-2);
  }
  std::string late() const { return result.late ? graph.tasks[result.late->task].name : ""; }
};
}  // namespace

TEST_SUITE("graph/analysis/check_wrong") {
  TEST_CASE("waiting for another core lets the backlog grow, though no core has too much to do") {
    const Judged j("cross_core_backlog");
    CHECK(j.result.verdict == Verdict::not_schedulable);
    CHECK(j.result.evidence == Evidence::proof);
    // each period core 1 waits 1 ms and works 10 ms
    CHECK(j.late() == "d");
    REQUIRE(j.result.late);
    CHECK(j.result.late->activation == 5);
    CHECK(j.result.late->finish == 61 * ms);
    CHECK(j.result.core_at_fault == 1);
  }

  TEST_CASE("a circle of waiting through two cores that takes longer than the period is found, and alpha says so") {
    const Judged j("cross_core_alpha");
    CHECK(j.result.verdict == Verdict::not_schedulable);
    CHECK(j.result.evidence == Evidence::proof);
    CHECK(j.result.reason == "waiting for other cores takes longer than there is time: the backlog grows");
    Budget budget;
    const auto margins = sensitivity_of(j.system, false, budget);
    REQUIRE((margins && margins->alpha));
    CHECK(*margins->alpha == doctest::Approx(10.0 / 10.1).scale(0).epsilon(2e-6));
  }

  TEST_CASE("under global EDF jitter and blocking count") {
    const Judged j("global_edf_jitter");
    CHECK(j.result.verdict == Verdict::not_schedulable);
    CHECK(j.result.evidence == Evidence::proof);
    CHECK(j.result.reason == "a task's 'wcet', 'blocking' and 'jitter' together are longer than its deadline");
  }

  TEST_CASE("in a table blocking takes time of the core, and the backlog grows by it") {
    const Judged j("table_blocking");
    CHECK(j.result.verdict == Verdict::not_schedulable);
    CHECK(j.result.evidence == Evidence::proof);
    CHECK(j.result.reason == "the tasks need more than the whole core");
    CHECK(Judged("table_blocking", "offset: 5ms, wcet: 5ms", "offset: 5ms, wcet: 4.9ms").result.verdict ==
          Verdict::schedulable);
  }

  TEST_CASE("who reads waits for the jitter and the blocking of whom it follows, under every policy") {
    for (const std::string policy :
         {"fixed_priority", "edf", "table", "edf_nonpreemptive", "fixed_priority_nonpreemptive"})
      for (const std::string held : {"jitter: 8ms", "blocking: 8ms"}) {
        CAPTURE(policy);
        CAPTURE(held);
        std::string text = Judged::text_of("dataflow_jitter", "fixed_priority", policy);
        text.replace(text.find("jitter: 8ms"), 11, held);
        const Result late = check(tests::graph_of(text));
        CHECK(late.verdict == Verdict::not_schedulable);
        text.replace(text.find("8ms"), 3, policy == "fixed_priority" ? "5ms" : "6ms");
        CHECK(check(tests::graph_of(text)).verdict == Verdict::schedulable);
      }
    // released 8 ms late, behind p, and interrupted by the next p
    CHECK(Judged("dataflow_jitter").response("r") == 13 * ms);
  }

  TEST_CASE("a task does not hold up its own activations") {
    const Judged j("lone_task_np_edf");
    CHECK(j.result.verdict == Verdict::schedulable);
    CHECK(j.result.evidence == Evidence::proof);
    CHECK(j.response("a") == 4 * ms);
  }

  TEST_CASE("with offsets that hold, two activations of a task are not both as near as its jitter allows") {
    const Judged j("given_offsets_jitter");
    CHECK(j.result.verdict == Verdict::schedulable);
    CHECK(j.result.evidence == Evidence::proof);
    CHECK(j.response("a") == 7 * ms);
    CHECK(j.response("b") == 6 * ms);
    CHECK(Judged("given_offsets_jitter", "deadline: 7ms", "deadline: 5.9ms").result.verdict ==
          Verdict::not_schedulable);
  }

  TEST_CASE("tasks that follow each other may go to different cores") {
    for (const std::string policy : {"fixed_priority", "edf", "table"}) {
      CAPTURE(policy);
      const Judged j("assignment", "fixed_priority", policy);
      CHECK(j.result.verdict == Verdict::schedulable);
      CHECK(j.result.evidence == (policy == "table" ? Evidence::proof : Evidence::safe));
      CHECK(std::count(j.result.core.begin(), j.result.core.end(), 0) == 3);
      CHECK(std::count(j.result.core.begin(), j.result.core.end(), 1) == 1);
    }
  }

  TEST_CASE("what is schedulable has no response beyond its deadline") {
    const Judged j("edf_slack");
    CHECK(j.result.verdict == Verdict::schedulable);
    CHECK(j.response("a") == 2 * ms);
    CHECK(j.response("b") == 2 * ms);
  }

  TEST_CASE("a table whose periods do not repeat in reach is judged by what may stand before each task") {
    const Judged j("coprime_table");
    CHECK(j.result.verdict == Verdict::schedulable);
    CHECK(j.result.evidence == Evidence::safe);
    for (const std::string task : {"a", "b", "c"}) CHECK(j.response(task) <= std::chrono::microseconds(3));
  }

  TEST_CASE("what holds up one task makes another late that it can't hold up: behind it, or by its rest") {
    for (const std::string policy : {"fixed_priority_nonpreemptive", "edf_nonpreemptive"})
      for (const std::string name : {"np_hold_up_over", "np_hold_up_interrupted"}) {
        CAPTURE(name);
        CAPTURE(policy);
        const Judged j(name, "fixed_priority_nonpreemptive", policy);
        CHECK(j.result.verdict == Verdict::unknown);
      }
  }

  TEST_CASE("the least deadline of a reader is one with which what it reads ends in time, too") {
    const Judged j("min_deadline");
    Budget budget;
    const auto margins = sensitivity_of(j.system, true, budget);
    REQUIRE((margins && margins->min_deadline[1]));
    const std::int64_t min_deadline = margins->min_deadline[1]->count();
    const std::string ns = std::to_string(min_deadline) + "ns, wcet: 1ms, priority: 3",
                      less = std::to_string(min_deadline - 1) + "ns, wcet: 1ms, priority: 3";
    CHECK(Judged("min_deadline", "wcet: 1ms, priority: 3", "deadline: " + ns).result.verdict == Verdict::schedulable);
    CHECK(Judged("min_deadline", "wcet: 1ms, priority: 3", "deadline: " + less).result.verdict ==
          Verdict::not_schedulable);
  }
}
