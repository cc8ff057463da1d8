#include "graph/expect/at_end.h"

#include <doctest/doctest.h>

#include "graph/values/sequence.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;

// What an operator commands.
struct Flight {
  double height = 1;
  std::array<double, 2> lean{3, 4};
  bool lands = false;
  static constexpr auto fields() {
    return describe(field<&Flight::height>("m"), field<&Flight::lean>("rad"), field<&Flight::lands>());
  }
};

struct Climb {
  static constexpr std::string_view summary = "for tests";
  struct In {
    Flight flight{};
    static constexpr auto fields() { return describe(field<&In::flight>()); }
  };
  struct Out {
    double height = 0;
    static constexpr auto fields() { return describe(field<&Out::height>("m")); }
  };
  static void run(const Tick&, const In&, Out&) {}
};

const Registry& registry() {
  static const Registry made = [] {
    Registry known;
    tasks::add_tasks(known);
    known.add(task_class<Climb>());
    known.add(DistributerClass{"Pilot",
                               "for tests",
                               {{"flight", Direction::in, &type_of<Flight>(), ""},
                                {"number", Direction::in, &type_of<double>(), ""},
                                {"window", Direction::in, &type_of<Sequence<double>>(), ""}},
                               false});
    return known;
  }();
  return made;
}

std::string text_of(const std::string& at_end) {
  return R"(graph: t
timing: {period: 10ms}
distributers: {p: {type: Pilot, link: {type: test}}}
communicators: {flight: {channel: p.flight}, number: {channel: p.number}, window: {channel: p.window}}
tasks: {r: {type: Relay}, m: {type: Mean}, c: {type: Climb}}
connections: [number -> r.in, window -> m.in, flight -> c.flight]
at_end: )" +
         at_end + "\n";
}

Graph graph_with(const std::string& at_end) {
  Problems problems;
  const auto source = std::make_shared<Source>(Source{"t.yaml", text_of(at_end)});
  const GraphSpec spec = load_spec(source, {}, problems);
  Graph graph = build_graph(spec, registry(), problems);
  expect::add_at_end(spec, graph, problems);
  problems.throw_if_any();
  return graph;
}
}  // namespace

TEST_SUITE("graph/expect/at_end") {
  TEST_CASE("a graph without it has none") { CHECK(!graph_with("null").at_end.has_value()); }

  TEST_CASE("it has the value that is commanded, the condition and the longest time") {
    const Graph graph = graph_with("{command: {number: -2}, until: r.out < 3, longest: 20s}");
    REQUIRE(graph.at_end.has_value());
    CHECK(graph.at_end->longest == std::chrono::seconds(20));
    REQUIRE(graph.at_end->commands.size() == 1);
    const EndCommand& command = graph.at_end->commands[0];
    CHECK(graph.communicators[command.communicator].name == "number");
    REQUIRE(command.stated.size() == 1);
    CHECK(command.stated[0].path == "");
    CHECK(*static_cast<const double*>(command.value.data()) == -2);
    const expect::Condition& until = graph.at_end->until;
    REQUIRE(until.signals.size() == 1);
    CHECK(until.signals[0].name == "r.out");
    CHECK(expect::holds(until.comparison, expect::calc_value(until.metric.value, {2.9})));
    CHECK(!expect::holds(until.comparison, expect::calc_value(until.metric.value, {3.0})));
  }

  TEST_CASE("of a struct the fields that are stated count, of an array all elements, in their units") {
    const Graph graph =
        graph_with("{command: {flight: {height: 20 cm, lean: [0, 90deg]}}, until: c.height < 1, longest: 1s}");
    const EndCommand& command = graph.at_end->commands.at(0);
    std::vector<std::string> stated;
    for (const Leaf& leaf : command.stated) stated.push_back(leaf.path);
    CHECK(stated == std::vector<std::string>{"height", "lean.0", "lean.1"});
    const auto& value = *static_cast<const Flight*>(command.value.data());
    CHECK(value.height == doctest::Approx(0.2));
    CHECK(value.lean[1] == doctest::Approx(1.5707963268));
    CHECK(graph.at_end->until.signals.at(0).name == "c.height");
  }

  TEST_CASE("a value of changing size can't be commanded") {
    CHECK_THROWS_WITH_AS(
        graph_with("{command: {window: [1, 2]}, until: r.out < 3, longest: 20s}"),
        "t.yaml:7:20: error: 'at_end' commands 'window', which carries a value of changing size; command what comes "
        "from an operator: flight, number\n"
        "  at_end: {command: {window: [1, 2]}, until: r.out < 3, longest: 20s}\n"
        "                     ^",
        SpecError);
  }
}
