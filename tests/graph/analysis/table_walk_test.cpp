#include "tests/graph/analysis/table_walk.h"

#include <doctest/doctest.h>

#include "tests/graph/analysis/random_sets.h"
#include "tests/graph/analysis/truth.h"

namespace {
using namespace jarol;
}  // namespace

TEST_SUITE("graph/analysis/table_walk") {
  TEST_CASE("walking a table until it repeats says what trying everything says") {
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
      truth::Set set = truth::random_set(seed, Policy::table, {});
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
}
