// In one file: all cases have one sensor that falls silent.
#include "runtime/execute/failsafe.h"

#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <stdexcept>

#include "runtime/jarol/jarol_core.h"
#include "tests/runtime/at_some_speed.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::lines_of;
using tests::run_graph;

// Brings a value at the instants that are given, and keeps what it is handed.
class Sensor : public ExternalSystem {
 public:
  Sensor(std::vector<std::pair<Duration, double>> values, std::vector<double>& handed)
      : values_(std::move(values)), handed_(handed) {}
  void reach(Duration instant) override { now_ = instant; }
  bool take(std::size_t, void* value) override {
    bool fresh = false;
    for (; next_ < values_.size() && values_[next_].first <= now_; ++next_) {
      *static_cast<double*>(value) = values_[next_].second;
      fresh = true;
    }
    return fresh;
  }
  void hand_over(std::size_t, const void* value) override { handed_.push_back(*static_cast<const double*>(value)); }

 private:
  std::vector<std::pair<Duration, double>> values_;
  std::vector<double>& handed_;
  Duration now_{};
  std::size_t next_ = 0;
};

Graph graph_with_timeout(const std::string& task = "Relay", int times = 1) {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    const Type* number = &type_of<double>();
    made.add(DistributerClass{
        "Plant", "for tests", {{"sensor", Direction::in, number, ""}, {"actuator", Direction::out, number, ""}}, true});
    return made;
  }();
  std::string text = R"(graph: t
timing: {period: 10ms}
distributers: {p: {type: Plant, link: {type: test}}}
communicators:
  i: {channel: p.sensor, timeout: 20ms}
  o: {channel: p.actuator, offset: 5ms, safe: -1}
tasks: {r: {type: TASK}}
connections: [i -> r.in, r.out -> o]
)";
  text.replace(text.find("TASK"), 4, task);
  return jarol::tests::graph_of(registry, tests::slowed(text, times));
}

std::vector<std::unique_ptr<ExternalSystem>> sensor(std::vector<std::pair<Duration, double>> values,
                                                    std::vector<double>& handed, int times = 1) {
  for (auto& value : values) value.first *= times;
  std::vector<std::unique_ptr<ExternalSystem>> systems;
  systems.push_back(std::make_unique<Sensor>(std::move(values), handed));
  return systems;
}
}  // namespace

TEST_SUITE("runtime/failsafe") {
  TEST_CASE("an actuator gets the safe value while its sensor's newest value is older than the time-out") {
    const Graph graph = graph_with_timeout();
    std::vector<double> handed;
    const auto run = run_graph(graph, 80ms, sensor({{0ms, 1}, {10ms, 2}, {50ms, 3}}, handed));
    // at 25 ms the value of 10 ms is 15 ms old, at 35 ms 25 ms
    CHECK(handed == std::vector<double>{1, 2, 2, -1, -1, 3, 3, -1});
    // the trace has what was handed over
    CHECK(lines_of(run, "o") == "5ms o=1; 15ms o=2; 25ms o=2; 35ms o=-1; 45ms o=-1; 55ms o=3; 65ms o=3; 75ms o=-1");
  }

  TEST_CASE("of two sensors that are awaited each one that is silent brings the safe value") {
    // the first brings a value until its end, the second until another
    struct Sensors : ExternalSystem {
      Sensors(std::array<Duration, 2> until, std::vector<double>& to) : ends(until), handed(to) {}
      void reach(Duration instant) override { now = instant; }
      bool take(std::size_t channel, void* value) override {
        *static_cast<double*>(value) = 1;
        return now <= ends[channel];
      }
      void hand_over(std::size_t, const void* value) override { handed.push_back(*static_cast<const double*>(value)); }
      std::array<Duration, 2> ends;
      std::vector<double>& handed;
      Duration now{};
    };
    Registry registry;
    tasks::add_tasks(registry);
    const Type* number = &type_of<double>();
    registry.add(DistributerClass{"Plant",
                                  "for tests",
                                  {{"first", Direction::in, number, ""},
                                   {"second", Direction::in, number, ""},
                                   {"actuator", Direction::out, number, ""}},
                                  true});
    const Graph graph = tests::graph_of(registry, R"(graph: t
timing: {period: 10ms}
distributers: {p: {type: Plant, link: {type: test}}}
communicators:
  i: {channel: p.first, timeout: 20ms}
  k: {channel: p.second, timeout: 20ms}
  o: {channel: p.actuator, offset: 5ms, safe: -1}
tasks: {s: {type: Sum}}
connections: [i -> s.a, k -> s.b, s.out -> o]
)");
    for (const auto until : {std::array<Duration, 2>{10ms, 1s}, std::array<Duration, 2>{1s, 10ms}}) {
      std::vector<double> handed;
      std::vector<std::unique_ptr<ExternalSystem>> systems;
      systems.push_back(std::make_unique<Sensors>(until, handed));
      run_graph(graph, 50ms, std::move(systems));
      CHECK(handed == std::vector<double>{2, 2, 2, -1, -1});
    }
  }

  TEST_CASE(
      "a sensor that never reported anything is silent from the start; a value that is not finite does not end it") {
    const Graph graph = graph_with_timeout();
    std::vector<double> handed;
    run_graph(graph, 40ms, sensor({{0ms, std::numeric_limits<double>::quiet_NaN()}, {20ms, 4}}, handed));
    CHECK(handed == std::vector<double>{-1, -1, 4, 4});
  }

  TEST_CASE("a run on the real clock that ends before its first instant hands over what is safe at zero") {
    const Graph graph = graph_with_timeout();
    std::vector<double> handed;
    RealClock clock(graph.tasks.size());
    Executor executor(graph, sensor({}, handed), {.clock = &clock});
    executor.close();
    CHECK(handed == std::vector<double>{-1});
    REQUIRE(executor.failsafe().at(0).at_end);
    CHECK(executor.failsafe().at(0).at_end->time == 0ms);
  }

  TEST_CASE("the report says how often, and from when to when") {
    const Graph graph = graph_with_timeout();
    std::vector<double> handed;
    Executor executor(graph, sensor({{0ms, 1}, {10ms, 2}, {50ms, 3}}, handed));
    executor.run_until(40ms);
    executor.run_until(80ms);
    REQUIRE(executor.failsafe().size() == 1);
    const FailsafeReport& report = executor.failsafe().front();
    CHECK(graph.communicators[report.communicator].name == "o");
    CHECK(report.times == 2);
    CHECK(report.commands == 3);
    CHECK(report.first == 35ms);
    CHECK(report.last == 75ms);
    CHECK(report.heard);
    CHECK(report.at_start == 0);
  }

  TEST_CASE("what is handed over before anything ever came is counted apart") {
    const Graph graph = graph_with_timeout();
    std::vector<double> handed;
    Executor executor(graph, sensor({{30ms, 1}}, handed));
    executor.run_until(30ms);
    CHECK_FALSE(executor.failsafe().front().heard);
    executor.run_until(80ms);
    const FailsafeReport& report = executor.failsafe().front();
    CHECK(handed == std::vector<double>{-1, -1, -1, 1, 1, -1, -1, -1});
    CHECK(report.heard);
    CHECK(report.at_start == 3);
    CHECK(report.times == 1);
    CHECK(report.commands == 3);
    CHECK(report.first == 55ms);
  }

  TEST_CASE("what decides is logical time: the real clock and any number of workers come to the same digest") {
    const Graph graph = graph_with_timeout();
    std::vector<double> handed;
    Executor executor(graph, sensor({{0ms, 1}, {50ms, 3}}, handed));
    executor.run_until(80ms);
    CHECK(tests::at_some_speed([&](int times) {
      const Graph slow = graph_with_timeout("Relay", times);
      RealClock clock(slow.tasks.size());
      Executor real(slow, sensor({{0ms, 1}, {50ms, 3}}, handed, times), {.clock = &clock});
      clock.start();
      real.run_until(times * 80ms);
      if (real.report().fault_count > 0) return false;
      Executor same(slow, sensor({{0ms, 1}, {50ms, 3}}, handed, times));
      same.run_until(times * 80ms);
      CHECK(real.report().digest == same.report().digest);
      return true;
    }));
    Executor several(graph, sensor({{0ms, 1}, {50ms, 3}}, handed), {.workers = 2, .sharing = Sharing::always});
    several.run_until(80ms);
    CHECK(several.report().digest == executor.report().digest);
    Executor other(graph, sensor({{0ms, 1}, {40ms, 3}}, handed));
    other.run_until(80ms);
    CHECK(other.report().digest != executor.report().digest);
  }

  TEST_CASE("on threads it is the same, by the core's rounds") {
    const Graph graph = graph_with_timeout();
    // rounds that a busy machine leaves out may be any, and all after the first
    CHECK(tests::at_some_speed([&](int times) {
      std::vector<double> handed;
      JarolCore core(graph, sensor({{0ms, 1}}, handed));
      core.run_for(times * 100ms);
      REQUIRE(core.failsafe().size() == 1);
      if (core.failsafe().front().times == 0) return false;
      CHECK(core.failsafe().front().times == 1);
      CHECK(core.failsafe().front().commands >= 1);
      CHECK(core.failsafe().front().first > 20ms);
      CHECK(handed.back() == -1);
      return true;
    }));
  }

  TEST_CASE("where a run in real time is closed the safe value is the last one, beside what is published") {
    const Graph graph = graph_with_timeout("Accumulate");
    const std::vector<std::pair<Duration, double>> beyond_double{{0ms, 1e308}, {10ms, 1e308}};
    std::vector<double> handed;
    Executor executor(graph, sensor(beyond_double, handed));
    executor.run_until(80ms);
    CHECK(executor.report().stopped);
    CHECK(handed == std::vector<double>{1e308});
    executor.close();
    CHECK(handed == std::vector<double>{1e308});  // on the virtual clock, in this process: it ends with the run
    CHECK_FALSE(executor.failsafe().front().at_end);
    CHECK(tests::at_some_speed([&](int times) {
      handed.clear();
      const Graph slow = graph_with_timeout("Accumulate", times);
      RealClock clock(slow.tasks.size());
      Executor real(slow, sensor(beyond_double, handed, times), {.clock = &clock});
      clock.start();
      real.run_until(times * 80ms);
      real.close();
      real.run_until(times * 90ms);
      real.close();
      CHECK(real.report().stopped);
      CHECK(handed.back() == -1);
      REQUIRE(real.failsafe().front().at_end);
      CHECK(real.failsafe().front().at_end->failure == "");
      if (tests::misses_of(real.report()) != "") return false;
      CHECK(handed == std::vector<double>{1e308, -1});
      handed.clear();
      Executor same(slow, sensor(beyond_double, handed, times));
      same.run_until(times * 80ms);
      CHECK(real.report().digest == same.report().digest);
      return true;
    }));
    // so it is where a run comes to its end
    CHECK(tests::at_some_speed([&](int times) {
      handed.clear();
      const Graph slow = graph_with_timeout("Accumulate", times);
      RealClock clock(slow.tasks.size());
      Executor whole(slow, sensor({{0ms, 1}}, handed), {.clock = &clock});
      clock.start();
      whole.run_until(times * 10ms);
      whole.close();
      // and nothing follows
      whole.run_until(times * 30ms);
      CHECK(whole.report().covered == times * 10ms);
      return tests::misses_of(whole.report()) == "" && handed == std::vector<double>{1, -1};
    }));
  }

  TEST_CASE("what an external system throws at the end that is no exception is why it was not handed the value") {
    struct Broken : Sensor {
      using Sensor::Sensor;
      void flush() override { throw 42; }
      bool outlives_run() const override { return true; }
    };
    const Graph graph = graph_with_timeout();
    std::vector<double> handed;
    std::vector<std::unique_ptr<ExternalSystem>> systems;
    systems.push_back(std::make_unique<Broken>(std::vector<std::pair<Duration, double>>{{0ms, 7}}, handed));
    Executor executor(graph, std::move(systems));
    executor.close(Futex::now() + 10s);
    CHECK(executor.failsafe()[0].at_end->failure == "something was thrown that is no exception");
  }

  TEST_CASE("an external system that is lost within an instant is handed the safe value all the same") {
    struct Lost : Sensor {
      Lost(std::vector<double>& handed, bool in_reach) : Sensor({{0ms, 7}}, handed), in_reach_(in_reach) {}
      void reach(Duration instant) override {
        Sensor::reach(instant);
        if (in_reach_ && instant == 20ms) throw std::runtime_error("it is lost");
      }
      bool take(std::size_t channel, void* value) override {
        if (++taken_ == 3 && !in_reach_) throw std::runtime_error("it is lost");
        return Sensor::take(channel, value);
      }
      bool outlives_run() const override { return true; }
      bool in_reach_;
      int taken_ = 0;
    };
    for (const bool in_reach : {true, false}) {
      CAPTURE(in_reach);
      const Graph graph = graph_with_timeout();
      std::vector<double> handed;
      std::vector<std::unique_ptr<ExternalSystem>> systems;
      systems.push_back(std::make_unique<Lost>(handed, in_reach));
      Executor executor(graph, std::move(systems));
      CHECK_THROWS_WITH_AS(executor.run_until(100ms), "it is lost", std::runtime_error);
      executor.close(Futex::now() + 10s);
      CHECK(handed == std::vector<double>{7, 7, -1});
      CHECK(executor.failsafe()[0].at_end->failure == "");
    }
  }

  TEST_CASE("so it is on threads") {
    const Graph graph = graph_with_timeout("Accumulate");
    std::vector<double> handed;
    JarolCore core(graph, sensor({{0ms, 1e308}, {1ms, 1e308}, {30ms, 1e308}}, handed));
    core.run_for(1min);  // two rounds, whenever they are
    core.close();
    CHECK(core.report().stopped);
    CHECK(handed.back() == -1);
    CHECK(core.failsafe().front().at_end);
  }
}
