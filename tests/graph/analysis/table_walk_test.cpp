#include "tests/graph/analysis/table_walk.h"

#include <doctest/doctest.h>

#include "graph/analysis/check.h"
#include "tests/graph/analysis/random_sets.h"
#include "tests/graph/analysis/truth.h"
#include "tests/how_many.h"

namespace {
using namespace jarol;
using analysis::Verdict;

std::vector<std::size_t> cores_of(const analysis::Result& result) {
  std::vector<std::size_t> core;
  for (const auto& c : result.core) core.push_back(c.value_or(0));
  return core;
}

std::uint64_t count_of_tables() { return tests::how_many(50'000, 1'000'000, 10'000); }
}  // namespace

TEST_SUITE("graph/analysis/table_walk") {
  TEST_CASE("walking a table until it repeats says what trying everything says") {
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
      truth::Set set = truth::random_set(seed, policies::table, {});
      for (truth::Task& t : set.tasks) t.core = t.core.value_or(0);
      const Graph graph = truth::graph_of(set);
      std::vector<std::size_t> core;
      for (const truth::Task& t : set.tasks) core.push_back(static_cast<std::size_t>(*t.core));
      const truth::TableWalk walk = truth::walk_table(graph, core);
      const truth::Truth all = truth_of(set, core, truth::places_in(graph), 100'000);
      CAPTURE(truth::yaml_of(set, "ns"));
      CAPTURE(all.witness);
      REQUIRE(walk.late.empty() == (all.answer == truth::Truth::Answer::schedulable));
      REQUIRE(all.answer != truth::Truth::Answer::too_large);
      if (walk.late.empty())
        for (std::size_t i = 0; i < core.size(); ++i) REQUIRE(walk.longest[i] == all.longest[i]);
    }
  }

  TEST_CASE("tables of chains from core to core, almost full: the verdict is exact, however late the backlog shows") {
    std::uint64_t holds = 0, fails = 0, fails_late = 0, wrong = 0;
    for (std::uint64_t seed = 0; seed < count_of_tables(); ++seed) {
      const truth::Set set = truth::random_chains(seed);
      const Graph graph = truth::graph_of(set);
      const analysis::Result said = analysis::check(graph);
      const truth::TableWalk walk = truth::walk_table(graph, cores_of(said));
      ++(walk.late.empty() ? holds : fails);
      fails_late += !walk.late.empty() && walk.hyperperiods > 3 ? 1U : 0U;
      bool right = said.verdict == (walk.late.empty() ? Verdict::schedulable : Verdict::not_schedulable) &&
                   said.evidence == analysis::Evidence::proof;
      for (std::size_t i = 0; i < set.tasks.size() && right && walk.late.empty(); ++i)
        right = said.response[i] == Duration(walk.longest[i]);
      if (!right && ++wrong == 1) FAIL_CHECK(truth::yaml_of(set, "ns"), "said: ", said.reason, "\ntrue: ", walk.late);
    }
    CHECK(wrong == 0);
    CHECK(holds > count_of_tables() / 10);
    CHECK(fails > count_of_tables() / 10);
    CHECK(fails_late > count_of_tables() / 5000);
  }
}
