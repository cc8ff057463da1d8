// What `check` says of random sets, and what runs on their platforms do: a "yes" is never followed by a miss.
#include <doctest/doctest.h>

#include <numeric>

#include "graph/analysis/check.h"
#include "graph/analysis/execution_times.h"
#include "tests/graph/analysis/random_sets.h"
#include "tests/how_many.h"

namespace {
using namespace jarol;
using analysis::ExecutionTimes, analysis::Fate, analysis::Schedule, analysis::Verdict;

std::uint64_t count_of_schedules() { return tests::how_many(400, 20'000, 60); }

// The first activation that is late or left out within so many hyperperiods after all offsets, as "a 3"; empty: none.
std::string first_miss(const Graph& graph, ExecutionTimes times, std::int64_t hyperperiods) {
  std::int64_t hyperperiod = 1, begin = 0;
  for (const Task& task : graph.tasks) {
    hyperperiod = std::lcm(hyperperiod, task.period.count());
    begin = std::max(begin, task.offset.count());
  }
  Schedule schedule = schedule_of(graph, std::move(times));
  std::string miss;
  std::int64_t earliest = begin + hyperperiods * hyperperiod;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Task& task = graph.tasks[i];
    for (std::int64_t k = 0; task.offset.count() + k * task.period.count() < earliest; ++k) {
      if (schedule.fate(i, k).kind == Fate::Kind::in_time) continue;
      miss = task.name + " " + std::to_string(k);
      earliest = task.offset.count() + k * task.period.count();
      break;
    }
  }
  return miss;
}
}  // namespace

TEST_SUITE("graph/analysis/schedule") {
  TEST_CASE("where check says yes no run has a miss: not at the WCETs, nor below them") {
    for (const Policy& policy :
         {policies::table, policies::fixed_priority, policies::edf, policies::fixed_priority_nonpreemptive,
          policies::edf_nonpreemptive, policies::global_edf}) {
      CAPTURE(policy.name);
      std::uint64_t yes = 0;
      for (std::uint64_t seed = 0; seed < count_of_schedules(); ++seed) {
        CAPTURE(seed);
        const Graph graph = truth::graph_of(truth::random_set(seed, policy, {.any_phasing = false}));
        if (analysis::check(graph).verdict != Verdict::schedulable) continue;
        ++yes;
        REQUIRE(first_miss(graph, ExecutionTimes::wcet(graph), 3) == "");
        for (std::uint64_t run = 0; run < 3; ++run)
          REQUIRE(first_miss(graph, ExecutionTimes::random(graph, run), 3) == "");
      }
      CHECK(yes > count_of_schedules() / 20);
    }
  }

  TEST_CASE("where check finds a late activation on one core the run at the WCETs has it, and none before") {
    for (const Policy& policy : {policies::table, policies::fixed_priority, policies::edf}) {
      CAPTURE(policy.name);
      std::uint64_t no = 0;
      for (std::uint64_t seed = 0; seed < count_of_schedules(); ++seed) {
        CAPTURE(seed);
        const Graph graph = truth::graph_of(truth::random_set(
            seed, policy, {.jitter = false, .blocking = false, .data_flow = false, .any_phasing = false, .cores = 1}));
        const analysis::Result said = analysis::check(graph);
        if (said.verdict != Verdict::not_schedulable) continue;
        ++no;
        // backlog grows by one at least from repetition to repetition, and no deadline is longer than 31
        REQUIRE(first_miss(graph, ExecutionTimes::wcet(graph), 64) != "");
        if (policy != policies::table || !said.late) continue;
        Schedule schedule = schedule_of(graph, ExecutionTimes::wcet(graph));
        const Fate& fate = schedule.fate(said.late->task, said.late->activation);
        REQUIRE(fate.kind == Fate::Kind::late);
        if (fate.response) REQUIRE(*fate.response == said.late->finish - said.late->release);
      }
      CHECK(no > count_of_schedules() / 20);
    }
  }
}
