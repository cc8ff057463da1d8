// What becomes of external systems at the end of a run.
#include "distributers/session/linked.h"

#include <doctest/doctest.h>

#include <stdexcept>

#include "tests/graph/graph_of.h"
#include "tests/runtime/outside.h"

namespace {
using namespace jarol;

// Can't keep something for the next run.
class UnkeptPlant : public tests::Outside {
 public:
  void finish() override { throw std::runtime_error("can't write the trim to 'trim.txt'"); }
};

Graph graph_of_plant() {
  Registry registry;
  tasks::add_tasks(registry);
  registry.add(tests::plant());
  return tests::graph_of(registry, R"(graph: t
timing: {period: 3ms}
distributers: {p: {type: Plant, link: {type: test}}}
communicators: {o: {channel: p.actuator}}
tasks: {c: {type: Counter}}
connections: [c.out -> o]
)");
}
}  // namespace

TEST_SUITE("distributers/linked") {
  TEST_CASE("what an external system could not keep is an error of the run's end, and no note") {
    const Graph graph = graph_of_plant();
    UnkeptPlant plant;
    std::vector<std::string> notes;
    Linked linked({&plant}, [&](const std::string& note) { notes.push_back(note); });
    RunEnd end;
    finish_links(linked, graph, end);
    CHECK(end.unkept == std::vector<std::string>{"can't write the trim to 'trim.txt'"});
    CHECK(notes.empty());
    CHECK_FALSE(end.must_end_at_once());
  }
}
