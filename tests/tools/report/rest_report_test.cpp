#include "tools/report/rest_report.h"

#include <doctest/doctest.h>

#include <csignal>
#include <nlohmann/json.hpp>

namespace {
using namespace jarol;
using namespace std::chrono_literals;

Graph graph_with_rest() {
  Graph graph;
  graph.at_end.emplace();
  graph.at_end->until.text = "state is ground";
  graph.at_end->longest = 20s;
  return graph;
}

RunEnd end_after(const Ending& ending) {
  RunEnd end;
  end.ending = ending;
  end.before_rest = ending;
  return end;
}
}  // namespace

TEST_SUITE("tools/rest_report") {
  TEST_CASE("conditions are judged up to where the way to rest began, and never beyond what was reached") {
    CHECK(judged_until({}, 10s, 4s) == 4s);
    CHECK(judged_until(3s, 10s, 4s) == 3s);
    CHECK(judged_until(10s, 10s, 14s) == 10s);
    CHECK(judged_until(3s, 10s, 2s) == 2s);  // a log that was cut before
  }

  TEST_CASE("a vehicle that is not at rest is said to be so, and one that was not heard not to be known") {
    const Graph graph = graph_with_rest();
    const RunEnd end = end_after(Ending::of_signal(SIGINT));
    using jarol::not_at_rest_text;
    CHECK(not_at_rest_text(graph, RestReport{1s, 3s, true, true}, end) == "");
    CHECK(not_at_rest_text(graph, RestReport{1s, 21s, false, true}, end) ==
          "the vehicle did not come to rest: 'state is ground' was not so within 20s");
    CHECK(not_at_rest_text(graph, RestReport{1s, 21s, false, false}, end) ==
          "whether the vehicle came to rest is not known: it was silent when 20s were over");
    CHECK(tools::to_json(graph, RestReport{1s, 21s, false, false}, end)["heard"] == false);
  }
}
