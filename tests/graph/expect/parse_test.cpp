#include <doctest/doctest.h>

#include "graph/expect/parse.h"
#include "graph/values/seed.h"
#include "tests/graph/graph_of.h"
#include "tests/graph/plant_registry.h"

namespace {
using namespace jarol;
using expect::Comparison;
using expect::Condition;
using expect::Reduction;

struct Truth {
  double depth = 0;
  double heading = 0;
  static constexpr auto fields() { return describe(field<&Truth::depth>("m"), field<&Truth::heading>("rad")); }
};

const char* const text = R"(
graph: t
timing: {period: 10ms}
distributers:
  boat: {type: Plant, link: {type: test}}
tasks:
  a: {type: Counter}
  b: {type: Accumulate}
  fins: {type: FinAllocator}
  depth: {type: DepthControl}
  watch: {type: LauvSupervisor}
connections:
  - a.out -> b.in
)";

const Graph& graph() {
  static const Graph made = [] {
    Problems ignored;  // inputs that are open
    return build_graph(load_spec(std::make_shared<Source>(Source{"t.yaml", text}), {}, ignored),
                       tests::plant_registry(), ignored);
  }();
  return made;
}

std::vector<expect::TrueValues> here() { return {{expect::TrueValues::Where::here, &type_of<Truth>()}}; }

Yaml yaml(const std::string& words) {
  Problems problems;
  return read_yaml(std::make_shared<Source>(Source{"c", words}), problems);
}

Condition parse(const std::string& words, const std::vector<expect::TrueValues>& vehicles = here()) {
  Problems problems;
  const auto condition = expect::parse_condition(yaml(words), graph(), vehicles, problems);
  problems.throw_if_any();
  REQUIRE(condition.has_value());
  return *condition;
}

std::string wrong_condition(const std::string& words) {
  Problems problems;
  const auto condition = expect::parse_condition(yaml(words), graph(), here(), problems);
  CHECK(!condition.has_value());
  REQUIRE(problems.size() == 1);
  return to_text(problems.list().front());
}

TEST_SUITE("graph/expect/parse") {
  TEST_CASE("a condition has a value, a reduction, a window of time and a comparison in the value's unit") {
    const Condition c = parse("max(abs(heading of boat)) after 30s < 2deg");
    CHECK(c.kind == Condition::Kind::metric);
    CHECK(c.metric.reduction == Reduction::max);
    CHECK(c.metric.unit == "rad");
    CHECK(c.metric.window.from == std::chrono::seconds(30));
    CHECK(!c.metric.window.to.has_value());
    CHECK(c.comparison.kind == Comparison::Kind::less);
    CHECK(c.comparison.limit == doctest::Approx(0.034906585));
    REQUIRE(c.signals.size() == 1);
    CHECK(c.signals[0].distributer == 0);
    CHECK(expect::calc_value(c.metric.value, {-0.5}) == 0.5);
  }

  TEST_CASE("without a reduction it is the final value, and the window may stand at the end") {
    const Condition c = parse("depth of boat within 0.1 of 3 between 5s and 10s");
    CHECK(c.metric.reduction == Reduction::final);
    CHECK(c.metric.window.from == std::chrono::seconds(5));
    CHECK(*c.metric.window.to == std::chrono::seconds(10));
    CHECK(c.comparison.limit == 0.1);
    CHECK(c.comparison.of == 3);
    CHECK(*parse("depth of boat < 3 before 10s").metric.window.to == std::chrono::seconds(10));
    CHECK(parse("depth of boat within 10 cm of -300 cm").comparison.of == doctest::Approx(-3));
  }

  TEST_CASE("values are added, subtracted, negated and wrapped, with brackets") {
    const auto value = [](const std::string& words, const std::vector<double>& signals) {
      return expect::calc_value(parse(words).metric.value, signals);
    };
    CHECK(value("a.out - b.out > 0", {5, 3}) == 2);
    CHECK(value("a.out - b.out - a.out > 0", {5, 3, 1}) == 1);
    CHECK(value("a.out - (b.out - a.out) > 0", {5, 3, 1}) == 3);
    CHECK(value("-a.out + 2 > 0", {5}) == -3);
    CHECK(value("abs(a.out - 7.5) > 0", {5}) == 2.5);
    CHECK(value("wrap(heading of boat - 90 deg) > 0", {-3.0}) == doctest::Approx(-3.0 - 1.57079632679 + 6.28318530718));
  }

  TEST_CASE("choices and truth values are compared by is, a truth value alone has to be true") {
    const Condition c = parse("always watch.condition.alarm is not none");
    CHECK(c.kind == Condition::Kind::always);
    CHECK(c.comparison.kind == Comparison::Kind::is_not);
    CHECK(expect::holds(c.comparison, c.comparison.limit + 1));
    CHECK(!expect::holds(c.comparison, c.comparison.limit));
  }

  TEST_CASE("the end of a name suffices where only one output has it") {
    CHECK(parse("never alarm is leak").signals[0].name == "watch.condition.alarm");
    CHECK(wrong_condition("out > 3") ==
          "c:1:1: error: 'expect': 'out' may be any of these; write one of: a.out, b.out\n  out > 3\n  ^");
  }

  TEST_CASE("a place within the text is shown by its column, in quotes too") {
    for (const std::string condition : {"a.out within -1 of 3", "settling_time(a.out to 3 within -1) < 2s"})
      CHECK(wrong_condition(condition).find("the tolerance is below zero; write how far it may be off") !=
            std::string::npos);
    CHECK(wrong_condition("max(a.out) afer 3s < 2").starts_with("c:1:12: error: "));
    CHECK(wrong_condition("\"max(a.out) afer 3s < 2\"").starts_with("c:1:13: error: "));
  }

  TEST_CASE("what is true elsewhere is not judged, whatever it is compared with") {
    const std::vector<expect::TrueValues> elsewhere(1);
    for (const char* words : {"depth of boat < 3m", "depth of boat is ground", "max(abs(x of boat)) after 3s < 2deg",
                              "never x of boat", "wrap(x of boat - y of boat) within 1deg of 3deg"})
      CHECK(parse(words, elsewhere).not_judged == "the vehicle of 'boat' is not simulated in this process");
  }

  TEST_CASE("what is measured is a metric, with a limit if it is compared, or the instant of a condition") {
    Problems problems;
    const auto measured = [&](const std::string& text) {
      return expect::parse_measured(yaml(text), "metric 'm'", graph(), here(), problems);
    };
    const auto metric = measured("settling_time(depth of boat to 3 within 5 cm) after 2s");
    REQUIRE(metric.has_value());
    CHECK(metric->condition.metric.reduction == Reduction::settling_time);
    CHECK(metric->condition.metric.target == 3);
    CHECK(metric->condition.metric.band == 0.05);
    CHECK(metric->condition.metric.unit == "s");
    CHECK(!metric->is_limit);
    CHECK(!metric->is_instant);
    const auto state = measured("watch.condition.alarm");
    REQUIRE(state.has_value());
    CHECK(!state->is_limit);
    for (const char* limit : {"max(depth of boat) after 2s < 3", "max(depth of boat) < 3 after 2s",
                              "never watch.condition.alarm is not none", "watch.condition.alarm is none"}) {
      const auto found = measured(limit);
      REQUIRE(found.has_value());
      CHECK(found->is_limit);
      CHECK(!found->is_instant);
    }
    const auto instant = measured("time of depth of boat > 2");
    REQUIRE(instant.has_value());
    CHECK(instant->is_instant);
    CHECK(!instant->is_limit);
    CHECK(instant->condition.kind == expect::Condition::Kind::once);
    const auto in_time = measured("time of depth of boat > 2 before 20s");
    REQUIRE(in_time.has_value());
    CHECK(in_time->is_limit);
    CHECK(problems.empty());
    CHECK(!measured("time of depth of boat"));
    CHECK(!measured("max(depth of boat) 3"));
    REQUIRE(problems.size() == 2);
    CHECK(problems.list()[0].text ==
          "metric 'm': a comparison is needed here: <, <=, >, >= or within, but it ends there");
  }

  TEST_CASE("no text makes it crash") {
    const std::vector<std::string> words{"a.out", "depth of boat", "max", "(", ")",  "abs", "<", "within", "of", "3m",
                                         "to",    "after",         "5s",  "-", "is", "not", "+", "never",  "3",  "%"};
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
      std::string some;
      std::uint64_t chance = spread_seed(seed, "words");
      for (std::uint64_t n = chance % 9; n > 0; --n)
        some += words[(chance = chance * 6364136223846793005 + 1) % words.size()] + " ";
      Problems problems;
      Yaml text_of_it;
      text_of_it.kind = Yaml::Kind::scalar;
      text_of_it.text = some;
      const auto condition = expect::parse_condition(text_of_it, graph(), here(), problems);
      CHECK(condition.has_value() == problems.empty());
    }
  }
}
}  // namespace
