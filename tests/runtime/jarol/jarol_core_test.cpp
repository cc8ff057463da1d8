// In one file: all cases run one core on threads.
#include "runtime/jarol/jarol_core.h"

#include <doctest/doctest.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "graph/text/errors.h"
#include "tests/graph/graph_of.h"
#include "tests/runtime/at_some_speed.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::graph_of;

constexpr const char* counting =
    "graph: t\ntasks:\n  c: {type: Counter, period: 10ms}\n  half: {type: Counter, period: 20ms}\n"
    "  s: {type: Sum, period: 10ms}\nconnections: [c.out -> s.a, half.out -> s.b]\n";

// Takes a while at one instant, and throws at every other if it is told to.
struct Troublesome {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    Duration slow{-1};
    Duration lasts{};
    bool throws = false;
    static constexpr auto fields() {
      return describe(field<&Param::slow>(), field<&Param::lasts>(), field<&Param::throws>());
    }
  };
  static void run(const Param& p, const Tick& tick) {
    if (tick.now == p.slow) std::this_thread::sleep_for(p.lasts);
    if (p.throws) throw std::runtime_error("too hot");
  }
};

// Writes down what is asked of it; at an instant it is slow or lost.
class External : public ExternalSystem {
 public:
  struct Diary {
    std::mutex mutex;  // a sensor and an actuator thread write in it
    std::vector<Duration> instants;
    std::size_t taken = 0;  // of channel 0
    std::vector<double> handed;
    Duration slow_at = Duration::max(), lasts{};
    Duration lost_at = Duration::max();  // in reach
    Duration lost_to = Duration::max();  // to what is handed over
  };
  explicit External(Diary& diary) : diary_(diary) {}
  void reach(Duration instant) override {
    {
      const std::lock_guard lock(diary_.mutex);
      diary_.instants.push_back(instant);
    }
    if (instant == diary_.slow_at) std::this_thread::sleep_for(diary_.lasts);
    if (instant >= diary_.lost_at) throw std::runtime_error("the other end is lost");
  }
  bool take(std::size_t channel, void*) override {
    if (channel == 0) ++diary_.taken;
    return false;
  }
  void hand_over(std::size_t, const void* value) override {
    const std::lock_guard lock(diary_.mutex);
    diary_.handed.push_back(*static_cast<const double*>(value));
    if (diary_.instants.back() >= diary_.lost_to) throw std::runtime_error("nobody takes it");
  }

 private:
  Diary& diary_;
};

Graph graph_with_outside(const std::string& text) {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(task_class<Troublesome>());
    const std::vector<ChannelClass> channels{{"sensor", Direction::in, &type_of<double>(), ""},
                                             {"actuator", Direction::out, &type_of<double>(), ""},
                                             {"gyroscope", Direction::in, &type_of<double>(), ""}};
    made.add(DistributerClass{"Plant", "for tests", channels, true});
    made.add(DistributerClass{"Operator", "for tests", channels, false});
    return made;
  }();
  return jarol::tests::graph_of(registry, text);
}

// A counter that goes to a vehicle and to an operator.
constexpr const char* reported = R"(graph: t
timing: {period: 10ms}
distributers: {a_plant: {type: Plant, link: {type: test}}, operator: {type: Operator, link: {type: test}}}
communicators: {to_plant: {channel: a_plant.actuator}, to_operator: {channel: operator.actuator}}
tasks: {c: {type: Counter}}
connections: [c.out -> to_plant, c.out -> to_operator]
)";

std::vector<std::unique_ptr<ExternalSystem>> systems_of(External::Diary& plant, External::Diary& op) {
  std::vector<std::unique_ptr<ExternalSystem>> systems;
  systems.push_back(std::make_unique<External>(plant));
  systems.push_back(std::make_unique<External>(op));
  return systems;
}
}  // namespace

TEST_SUITE("runtime/jarol_core") {
  TEST_CASE("the core runs each task that is due by counting rounds, once, in data-flow order") {
    // again where the machine left out all of them
    CHECK(tests::at_some_speed([](int times) {
      const Graph graph = graph_of(tests::slowed(counting, times));
      JarolCore core(graph, {});
      CHECK(core.period() == times * 10ms);
      core.run_for(times * 250ms);
      const std::uint64_t rounds = core.threads_report().rounds;
      CHECK(rounds <= 25);
      CHECK(core.threads_report().round.count() == rounds);
      CHECK(core.report().fault_count == 0);
      if (rounds == 0) return false;
      // a busy machine may leave out rounds, also those in which the slow task was due
      CHECK(core.report().activations > 2 * rounds);
      CHECK(core.report().activations <= 2 * rounds + std::min<std::uint64_t>(rounds, 13));
      return true;
    }));
  }

  TEST_CASE("undisturbed it has the digest of a data-flow graph as exotasks") {
    CHECK(tests::at_some_speed([](int times) {
      const Graph graph = graph_of(tests::slowed(counting, times));
      JarolCore core(graph, {});
      core.run_for(times * 95ms);
      if (core.threads_report().rounds != 10) return false;
      Executor executor(graph, {});
      executor.run_until(times * 95ms);
      CHECK(core.report().digest == executor.report().digest);
      return true;
    }));
  }

  TEST_CASE("it covers the instants before the end, and reports the time covered, also where rounds were left out") {
    for (const Duration whole : {35ms, 40ms})
      CHECK(tests::at_some_speed([&](int times) {
        const Graph graph = graph_with_outside(tests::slowed(reported, times));
        const Duration end = times * whole;
        External::Diary plant, op;
        JarolCore core(graph, systems_of(plant, op));
        const auto before = MachineClock::now();
        core.run_for(end);
        CHECK(MachineClock::now() >= before + end);
        CHECK(core.report().simulated == end);
        CHECK(core.now() == end);
        CHECK(plant.instants.size() + core.threads_report().unawaited_ticks == 4);
        if (plant.instants.empty()) return false;  // all of them
        CHECK(plant.instants.back() < end);
        // what the core has computed last was handed over
        const double last = *static_cast<const double*>(core.last_value(0));
        CHECK(plant.handed.back() == last);
        CHECK(op.handed.back() == last);
        return true;
      }));
  }

  TEST_CASE("the run begins when its threads are prepared") {
    CHECK(tests::at_some_speed([](int times) {
      const Graph graph = graph_of(tests::slowed(counting, times));
      JarolCore core(graph, {});
      int prepared = 0;
      MachineClock::time_point last;
      std::mutex mutex;
      core.run_for(times * 15ms, [&] {
        std::this_thread::sleep_for(times * 30ms);
        const std::lock_guard lock(mutex);
        ++prepared;
        last = MachineClock::now();
      });
      CHECK(MachineClock::now() >= last + times * 15ms);
      CHECK(prepared == 5);  // the caller's too
      return core.threads_report().rounds == 2 && core.threads_report().unawaited_ticks == 0;
    }));
  }

  TEST_CASE("what is due in a round that was left out comes in the next") {
    // the round at 200 ms is left out
    bool sensor_is_slow = false;
    SUBCASE("as the core was at work") {}
    SUBCASE("as the sensor thread was at work") { sensor_is_slow = true; }
    const std::string text = R"(graph: t
timing: {period: 200ms}
distributers: {a_plant: {type: Plant, link: {type: test}}}
communicators:
  from: {channel: a_plant.sensor}
  to: {channel: a_plant.actuator}
  often: {channel: a_plant.gyroscope, period: 10ms}
tasks:
  long: {type: Troublesome, period: 10ms, parameters: {lasts: 25ms, slow: )" +
                             std::string(sensor_is_slow ? "400ms" : "190ms") + R"(}}
  seldom: {type: Sum}
  relay: {type: Relay, period: 10ms}
connections: [from -> seldom.a, from -> seldom.b, seldom.out -> to, often -> relay.in]
)";
    // again where the machine left out more: all before, or all from then on
    CHECK(tests::at_some_speed([&](int times) {
      const Graph graph = graph_with_outside(tests::slowed(text, times));
      External::Diary plant;
      plant.lasts = times * 25ms;
      if (sensor_is_slow) plant.slow_at = times * 190ms;
      std::vector<std::unique_ptr<ExternalSystem>> systems;
      systems.push_back(std::make_unique<External>(plant));
      JarolCore core(graph, std::move(systems));
      core.run_for(times * 350ms);
      CHECK(plant.taken <= 2);
      CHECK(plant.handed.size() <= 2);
      const std::uint64_t rounds = core.threads_report().rounds;
      return plant.taken == 2 && plant.handed.size() == 2 && core.report().activations == 2 * rounds + 2 && rounds < 35;
    }));
  }

  TEST_CASE("activations are numbered by the clock, also after rounds that were left out") {
    const std::string text = R"(graph: t
timing: {period: 10ms}
distributers: {a_plant: {type: Plant, link: {type: test}}}
communicators: {to_plant: {channel: a_plant.actuator}}
tasks: {c: {type: Counter}, long: {type: Troublesome, parameters: {lasts: 55ms, slow: 50ms}}}
connections: [c.out -> to_plant]
)";
    CHECK(tests::at_some_speed([&](int times) {
      const Graph graph = graph_with_outside(tests::slowed(text, times));
      External::Diary plant;
      std::vector<std::unique_ptr<ExternalSystem>> systems;
      systems.push_back(std::make_unique<External>(plant));
      JarolCore core(graph, std::move(systems));
      core.run_for(times * 200ms);
      // again where the machine was too slow for the round at 50 ms, or for the last
      if (core.threads_report().rounds > 16 || plant.handed.empty()) return false;
      return plant.handed.back() == 19;
    }));
  }

  TEST_CASE("every fault is counted, the first thousand are reported") {
    std::string text = "graph: t\ntiming: {period: 1ms}\ntasks:\n";
    for (int i = 0; i < 50; ++i)
      text += "  t" + std::to_string(i) + ": {type: Troublesome, on_fault: hold, parameters: {throws: true}}\n";
    const Graph graph = graph_with_outside(text);
    std::uint64_t count = 0;
    for (Duration end = 100ms; count <= 1000 && end < 10s; end *= 2) {
      JarolCore core(graph, {});
      core.run_for(end);
      count = core.report().fault_count;
      CHECK(count == 50 * core.threads_report().rounds);
      CHECK(core.report().faults.size() == std::min<std::uint64_t>(count, 1000));
    }
    CHECK(count > 1000);
  }

  TEST_CASE("what goes wrong in one of its threads ends all, and is thrown by the run") {
    const Graph graph = graph_with_outside(reported);
    External::Diary plant, op;
    std::string error = "the other end is lost";
    SUBCASE("in the sensor thread") { plant.lost_at = 30ms; }
    SUBCASE("in the terminal thread") { op.lost_at = 30ms; }
    SUBCASE("in the actuator thread") {
      plant.lost_to = 30ms;
      error = "nobody takes it";
    }
    SUBCASE("in several") { plant.lost_at = op.lost_at = 30ms; }
    JarolCore core(graph, systems_of(plant, op));
    CHECK_THROWS_WITH_AS(core.run_for(1h), error.c_str(), std::runtime_error);
    CHECK(core.now() >= 30ms);
    CHECK(core.now() < 1h);
  }

  TEST_CASE("a thread that can't be prepared ends the run before it begins") {
    const Graph graph = graph_of(counting);
    JarolCore core(graph, {});
    CHECK_THROWS_WITH_AS(core.run_for(1h, [] { throw std::runtime_error("not here"); }), "not here",
                         std::runtime_error);
    CHECK(core.threads_report().rounds == 0);
    CHECK(core.report().simulated == 0ms);
  }

#ifndef JAROL_SANITIZED  // they need memory of their own
  TEST_CASE("where the system has no more threads the run ends before it begins") {
    const pid_t child = fork();
    if (child == 0) {
      // there is room for the stacks of two threads at most
      constexpr std::size_t stack = 64U << 20;
      pthread_attr_t attributes;
      pthread_attr_init(&attributes);
      pthread_attr_setstacksize(&attributes, stack);
      pthread_setattr_default_np(&attributes);
      const Graph graph = graph_of(counting);
      JarolCore core(graph, {});
      std::size_t pages = 0;
      std::ifstream("/proc/self/statm") >> pages;
      const rlim_t room = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + 2 * stack + stack / 2;
      const rlimit limit{room, room};
      setrlimit(RLIMIT_AS, &limit);
      std::string error;
      try {
        core.run_for(1h);
      } catch (const std::runtime_error& thrown) { error = thrown.what(); }
      _exit(error == "no thread can be started: Resource temporarily unavailable" ? 0 : 1);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(status == 0);
  }
#endif

  TEST_CASE("periods that can't be counted in those of the sensor thread are refused") {
    const Graph graph =
        graph_of("graph: t\ntasks: {a: {type: Counter, period: 10ms}, b: {type: Counter, period: 15ms}}\n");
    CHECK_THROWS_WITH_AS(
        JarolCore(graph, {}),
        "threads count in periods of the vehicle's channels, 10ms; task 'b' has 15ms, which is no multiple of it",
        InputError);
  }

  TEST_CASE("an interrupt ends it") {
    const Graph graph = graph_of(counting);
    JarolCore core(graph, {});
    std::thread other([&] {
      std::this_thread::sleep_for(30ms);
      core.interrupt();
    });
    core.run_for(1h);
    other.join();
    CHECK(core.threads_report().rounds < 100'000);  // of 360 000
  }
}
