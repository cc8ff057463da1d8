#include "runtime/threads_core.h"

#include <doctest/doctest.h>

#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::graph_of;

constexpr const char* counting =
    "graph: t\ntasks:\n  c: {type: Counter, period: 10ms}\n  half: {type: Counter, period: 20ms}\n"
    "  s: {type: Sum, period: 10ms}\nconnections: [c.out -> s.a, half.out -> s.b]\n";

// Writes down what is asked of it; at an instant it is lost.
class External : public Channels {
 public:
  struct Diary {
    std::vector<Duration> instants;
    std::vector<double> handed;
    Duration lost_at = Duration::max();  // in reach
    Duration lost_to = Duration::max();  // to what is handed over
  };
  explicit External(Diary& diary) : diary_(diary) {}
  void reach(Duration instant) override {
    diary_.instants.push_back(instant);
    if (instant >= diary_.lost_at) throw std::runtime_error("the other end is lost");
  }
  bool take(std::size_t, void*) override { return false; }
  void hand_over(std::size_t, const void* value) override {
    diary_.handed.push_back(*static_cast<const double*>(value));
    if (diary_.instants.back() >= diary_.lost_to) throw std::runtime_error("nobody takes it");
  }

 private:
  Diary& diary_;
};

// A counter that goes to a vehicle and to an operator.
Graph graph_with_outside() {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    const std::vector<ChannelClass> channels{{"actuator", Direction::out, &type_of<double>(), ""}};
    made.add(DistributerClass{"Plant", "for tests", channels, true});
    made.add(DistributerClass{"Operator", "for tests", channels, false});
    return made;
  }();
  const std::string text = R"(graph: t
timing: {period: 10ms}
distributers: {a_plant: {type: Plant, link: {type: test}}, operator: {type: Operator, link: {type: test}}}
communicators: {to_plant: {channel: a_plant.actuator}, to_operator: {channel: operator.actuator}}
tasks: {c: {type: Counter}}
connections: [c.out -> to_plant, c.out -> to_operator]
)";
  Problems problems;
  Graph graph =
      build_graph(load_spec(std::make_shared<Source>(Source{"t.yaml", text}), {}, problems), registry, problems);
  problems.throw_if_any();
  return graph;
}

std::vector<std::unique_ptr<Channels>> channels_of(External::Diary& plant, External::Diary& op) {
  std::vector<std::unique_ptr<Channels>> channels;
  channels.push_back(std::make_unique<External>(plant));
  channels.push_back(std::make_unique<External>(op));
  return channels;
}
}  // namespace

TEST_SUITE("runtime/threads_core") {
  TEST_CASE("the core runs each task that is due by counting rounds, once, in data-flow order") {
    const Graph graph = graph_of(counting);
    ThreadsCore core(graph, {});
    CHECK(core.period() == 10ms);
    core.run_for(250ms);
    const std::uint64_t rounds = core.threads_report().rounds;
    CHECK(rounds > 0);
    CHECK(rounds <= 25);
    // a busy machine may leave out rounds, also those in which the slow task was due
    CHECK(core.report().activations >= 2 * rounds);
    CHECK(core.report().activations <= 2 * rounds + rounds / 2 + 1);
    CHECK(core.threads_report().round.count() == rounds);
    CHECK(core.report().fault_count == 0);
  }

  TEST_CASE("undisturbed it has the digest of a data-flow graph as exotasks") {
    const Graph graph = graph_of(counting);
    Executor executor(graph, {});
    executor.run_until(95ms);
    bool same = false;
    for (int attempt = 0; attempt < 50 && !same; ++attempt) {
      ThreadsCore core(graph, {});
      core.run_for(95ms);
      if (core.threads_report().rounds != 10) continue;
      same = core.report().digest == executor.report().digest;
      CHECK(same);
    }
    CHECK(same);
  }

  TEST_CASE("it covers the instants before the end, and tells the time covered, also where rounds were left out") {
    const Graph graph = graph_with_outside();
    for (const Duration end : {35ms, 40ms}) {
      External::Diary plant, op;
      ThreadsCore core(graph, channels_of(plant, op));
      const auto before = MachineClock::now();
      core.run_for(end);
      CHECK(MachineClock::now() >= before + end);
      CHECK(core.report().simulated == end);
      CHECK(core.now() == end);
      REQUIRE_FALSE(plant.instants.empty());
      CHECK(plant.instants.back() < end);
      CHECK(plant.instants.size() + core.threads_report().unawaited_ticks == 4);
      // what the core has computed last was handed over
      const double last = *static_cast<const double*>(core.last_value(0));
      CHECK(plant.handed.back() == last);
      CHECK(op.handed.back() == last);
    }
  }

  TEST_CASE("the run begins when its threads are prepared") {
    const Graph graph = graph_of(counting);
    bool undisturbed = false;
    for (int attempt = 0; attempt < 50 && !undisturbed; ++attempt) {
      ThreadsCore core(graph, {});
      int prepared = 0;
      MachineClock::time_point last;
      std::mutex mutex;
      core.run_for(15ms, [&] {
        std::this_thread::sleep_for(30ms);
        const std::lock_guard lock(mutex);
        ++prepared;
        last = MachineClock::now();
      });
      CHECK(MachineClock::now() >= last + 15ms);
      CHECK(prepared == 5);  // the caller's too
      undisturbed = core.threads_report().rounds == 2 && core.threads_report().unawaited_ticks == 0;
    }
    CHECK(undisturbed);
  }

  TEST_CASE("what goes wrong in one of its threads ends all, and is thrown by the run") {
    const Graph graph = graph_with_outside();
    External::Diary plant, op;
    std::string error = "the other end is lost";
    SUBCASE("in the sensor thread") { plant.lost_at = 30ms; }
    SUBCASE("in the terminal thread") { op.lost_at = 30ms; }
    SUBCASE("in the actuator thread") {
      plant.lost_to = 30ms;
      error = "nobody takes it";
    }
    SUBCASE("in several") { plant.lost_at = op.lost_at = 30ms; }
    ThreadsCore core(graph, channels_of(plant, op));
    CHECK_THROWS_WITH_AS(core.run_for(1h), error.c_str(), std::runtime_error);
    CHECK(core.now() >= 30ms);
    CHECK(core.now() < 1h);
  }

  TEST_CASE("a thread that can't be prepared ends the run before it begins") {
    const Graph graph = graph_of(counting);
    ThreadsCore core(graph, {});
    CHECK_THROWS_WITH_AS(core.run_for(1h, [] { throw std::runtime_error("not here"); }), "not here",
                         std::runtime_error);
    CHECK(core.threads_report().rounds == 0);
    CHECK(core.report().simulated == 0ms);
  }

  TEST_CASE("periods that can't be counted in those of the sensor thread are refused") {
    const Graph graph =
        graph_of("graph: t\ntasks: {a: {type: Counter, period: 10ms}, b: {type: Counter, period: 15ms}}\n");
    CHECK_THROWS_WITH_AS(
        ThreadsCore(graph, {}),
        "threads count in periods of the vehicle's channels, 10ms; task 'b' has 15ms, which is no multiple of it",
        std::invalid_argument);
  }

  TEST_CASE("an interrupt ends it") {
    const Graph graph = graph_of(counting);
    ThreadsCore core(graph, {});
    std::thread other([&] {
      std::this_thread::sleep_for(30ms);
      core.interrupt();
    });
    core.run_for(1h);
    other.join();
    CHECK(core.threads_report().rounds < 1000);
  }
}
