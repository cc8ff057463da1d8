#include "graph/model/stages.h"

#include <doctest/doctest.h>

#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using Numbers = std::vector<std::uint32_t>;
}  // namespace

TEST_SUITE("graph/stages") {
  TEST_CASE("a reader has a later stage than a producer of another period that may be due with it, and no other") {
    const Graph graph = tests::graph_of(R"(graph: t
timing: {period: 120ms}
tasks:
  a: {type: Counter, period: 10ms}
  b_together: {type: Relay, period: 10ms}
  c_after_both: {type: Relay, period: 20ms}
  d_apart: {type: Relay, period: 10ms, offset: 5ms}
  e_let: {type: Relay, period: 20ms, let: 5ms}
  f_of_let: {type: Relay, period: 40ms}
  g_at_times: {type: Relay, period: 15ms, offset: 5ms}
connections:
  - a.out -> b_together.in
  - b_together.out -> c_after_both.in
  - a.out -> d_apart.in
  - a.out -> e_let.in
  - e_let.out -> f_of_let.in
  - a.out -> g_at_times.in
)");
    const Stages stages = stages_of(graph);
    CHECK(stages.stage == Numbers{0, 0, 1, 0, 1, 0, 1});
    CHECK(stages.level == Numbers{0, 1, 0, 0, 0, 0, 0});
  }
}
