// Outputs of LET tasks are looked at together at the ends of their LETs.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <stdexcept>

#include "runtime/dispatch/finite.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::lines_of;

constexpr double greatest = std::numeric_limits<double>::max();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Publishes 1, and at activation `at` something greater, or NaN, or throws.
struct Param {
  std::int64_t at = 1;
  double times = 0;  // the greatest number
  bool nan = false;
  bool throws = false;
  static constexpr auto fields() {
    return describe(field<&Param::at>(), field<&Param::times>(), field<&Param::nan>(), field<&Param::throws>());
  }
};

double value_of(const Param& p, const Tick& tick) {
  if (tick.activation != p.at) return 1;
  if (p.throws) throw std::runtime_error("too hot");
  return p.nan ? not_a_number : 1 + p.times * greatest;
}

struct Doubles {
  static constexpr std::string_view summary = "for tests";
  using Param = ::Param;
  struct Out {
    double first = 0, second = 0;
    static constexpr auto fields() { return describe(field<&Out::first>(), field<&Out::second>()); }
  };
  static void run(const Param& p, const Tick& tick, Out& out) {
    out.first = 1;
    out.second = value_of(p, tick);
  }
};

struct Mixed {
  static constexpr std::string_view summary = "for tests";
  using Param = ::Param;
  struct Out {
    std::int64_t bits = 0;
    double number = 0;
    static constexpr auto fields() { return describe(field<&Out::bits>(), field<&Out::number>()); }
  };
  static void run(const Param& p, const Tick& tick, Out& out) {
    out.bits = -1;  // as a double, it would not be finite
    out.number = value_of(p, tick);
  }
};

Graph graph_with(const std::string& tasks, const std::string& connections = "") {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(task_class<Doubles>());
    made.add(task_class<Mixed>());
    return made;
  }();
  return tests::graph_of(registry, "graph: t\ntiming: {period: 10ms}\ntasks:\n" + tasks + connections);
}

tests::Run run_doubles(const std::string& tasks, Duration end, const std::string& connections = "") {
  return tests::run_graph(graph_with(tasks, connections), end);
}

std::string faults_of(const Report& report) {
  std::string text;
  for (const Fault& fault : report.faults) text += (text.empty() ? "" : "; ") + to_text(fault);
  return text;
}
}  // namespace

TEST_SUITE("runtime/let_faults") {
  TEST_CASE("of LET tasks that end together the one whose output is not finite is reported, the others publish") {
    const auto r = run_doubles(
        "  a: {type: Doubles, let: 5ms}\n  b: {type: Doubles, let: 5ms, parameters: {at: 2, times: -2}}\n"
        "  c: {type: Doubles, let: 5ms}\n  d: {type: Mixed, let: 5ms}\n",
        100ms);
    CHECK(faults_of(r.report) == "task 'b' activation 2 at 0.025 s: output 'second' is -inf");
    CHECK(r.report.stopped);
    CHECK(lines_of(r, "a.second") == "5ms a.second=1; 15ms a.second=1; 25ms a.second=1");
    CHECK(lines_of(r, "b.first") == "5ms b.first=1; 15ms b.first=1");
    CHECK(lines_of(r, "c.first") == "5ms c.first=1; 15ms c.first=1; 25ms c.first=1");
    CHECK(lines_of(r, "d.number") == "5ms d.number=1; 15ms d.number=1; 25ms d.number=1");
  }

  TEST_CASE("readers keep the last finite value of a LET task, also at the instant of its fault") {
    const auto r = run_doubles(
        "  a: {type: Doubles, let: 10ms, parameters: {nan: true}}\n  r: {type: Relay}\n"
        "  t: {type: Doubles, let: 5ms, offset: 5ms}\n",
        100ms, "connections: [a.second -> r.in]\n");
    CHECK(faults_of(r.report) == "task 'a' activation 1 at 0.02 s: output 'second' is nan");
    CHECK(lines_of(r, "r.out") == "0ns r.out=0; 10ms r.out=1; 20ms r.out=1");
  }

  TEST_CASE("a LET task whose outputs are not all doubles is looked at as well") {
    const auto r = run_doubles("  a: {type: Mixed, let: 4ms, offset: 3ms, parameters: {at: 3, times: 2}}\n", 100ms);
    CHECK(faults_of(r.report) == "task 'a' activation 3 at 0.037 s: output 'number' is inf");
    CHECK(lines_of(r, "a.bits") == "7ms a.bits=-1; 17ms a.bits=-1; 27ms a.bits=-1");
  }

  TEST_CASE("finite values whose sum is not are no fault") {
    std::string tasks;
    for (const char* name : {"a", "b", "c"})
      tasks += std::string("  ") + name + ": {type: Doubles, let: 5ms, parameters: {times: 0.5}}\n";
    const auto r = run_doubles(tasks, 30ms);
    CHECK(faults_of(r.report).empty());
    CHECK(lines_of(r, "c.second") == "5ms c.second=1; 15ms c.second=8.988465674311579e+307; 25ms c.second=1");
  }

  TEST_CASE("a LET task that throws ends its own activation alone") {
    const auto r = run_doubles(
        "  a: {type: Doubles, let: 5ms}\n  b: {type: Doubles, let: 5ms, parameters: {throws: true}}\n"
        "  c: {type: Mixed, let: 5ms, parameters: {throws: true}}\n  d: {type: Doubles, let: 5ms}\n",
        100ms);
    CHECK(faults_of(r.report) ==
          "task 'b' activation 1 at 0.015 s: threw: too hot; task 'c' activation 1 at 0.015 s: threw: too hot");
    CHECK(lines_of(r, "a.second") == "5ms a.second=1; 15ms a.second=1");
    CHECK(lines_of(r, "c.bits") == "5ms c.bits=-1");
    CHECK(lines_of(r, "d.second") == "5ms d.second=1; 15ms d.second=1");
  }

  TEST_CASE("several workers, who look at once, report the same faults and publish the same") {
    for (const std::string what : {"nan: true", "times: 2", "times: 0.5", "throws: true", "at: -1"}) {
      CAPTURE(what);
      std::string tasks = "  m: {type: Mixed, let: 10ms, parameters: {" + what + "}}\n";
      for (const char* name : {"a", "b", "c"})
        tasks += std::string("  ") + name + ": {type: Doubles, let: 10ms, parameters: {" + what + "}}\n";
      const Graph graph = graph_with(tasks + "  other: {type: Doubles, let: 4ms, offset: 6ms}\n");
      Executor one(graph, {});
      one.run_until(50ms);
      for (const std::size_t workers : {2, 4}) {
        Executor several(graph, {}, {.workers = workers, .sharing = Sharing::always});
        several.run_until(50ms);
        CHECK(faults_of(several.report()) == faults_of(one.report()));
        CHECK(several.report().digest == one.report().digest);
        CHECK(several.report().activations == one.report().activations);
      }
    }
  }

  TEST_CASE("numbers are surely finite unless one is not, wherever it stands, or their sum is too great") {
    for (const bool wide : {false, has_wide_vectors})
      for (const std::size_t count : {8, 16, 24, 64, 72}) {
        alignas(64) std::array<double, 72> room{};
        const std::span<double> numbers(room.data(), count);
        std::fill(numbers.begin(), numbers.end(), -1.0);
        const auto are_finite = [&] { return are_surely_finite(room.data(), room.data() + count, wide); };
        CHECK(are_finite());
        for (double& number : numbers)
          for (const double other : {infinity, -infinity, not_a_number}) {
            const double before = std::exchange(number, other);
            CHECK_FALSE(are_finite());
            number = before;
          }
        numbers[0] = numbers[1] = -greatest;
        CHECK_FALSE(are_finite());
        numbers[1] = greatest;
        CHECK(are_finite());
      }
  }
}
