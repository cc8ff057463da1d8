// Several workers give what one gives.
#include "runtime/dispatch/stage_team.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "tests/how_many.h"
#include "tests/runtime/random_model.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

constexpr std::array<std::size_t, 3> counts{2, 4, 8};

std::uint64_t graph_count() { return tests::how_many(1'000, 1'000, 40); }

// Threads that do nothing but take processors away.
class Load {
 public:
  explicit Load(int threads) {
    for (int i = 0; i < threads; ++i)
      threads_.emplace_back([this] {
        while (!end_.load(std::memory_order_relaxed)) {}
      });
  }
  ~Load() {
    end_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  std::atomic<bool> end_{false};
  std::vector<std::thread> threads_;
};

struct Result {
  std::uint64_t digest = 0, activations = 0, faults = 0;
  std::string first_fault;
  bool operator==(const Result&) const = default;
};

Result run_with(const Graph& graph, std::size_t workers, Sharing sharing, Duration end) {
  Executor executor(graph, {}, {.digest = true, .recorder = nullptr, .workers = workers, .sharing = sharing});
  executor.run_until(end);
  const Report& r = executor.report();
  return {r.digest, r.activations, r.fault_count, r.faults.empty() ? "" : to_text(r.faults[0])};
}

// On a busy machine workers that wait for each other take long: fewer graphs then, but with JAROL_FULL.
void check_random_graphs(std::uint64_t count) {
  const auto end = std::chrono::steady_clock::now() + (tests::is_full() ? 1h : 5s);
  for (std::uint64_t seed = 0; seed < count && (seed < 10 || std::chrono::steady_clock::now() < end); ++seed) {
    const Graph graph = tests::graph_of(oracle::to_yaml(oracle::random_model(seed), 0));
    const Result one = run_with(graph, 1, Sharing::if_it_pays, 20ms);
    CAPTURE(seed);
    for (const std::size_t workers : counts) {
      CAPTURE(workers);
      REQUIRE(run_with(graph, workers, Sharing::always, 20ms) == one);
    }
  }
}

// Fails at every third activation.
struct Unsteady {
  static constexpr std::string_view summary = "for tests";
  struct State {
    double runs = 0;
    static constexpr auto fields() { return describe(field<&State::runs>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick& tick, State& state, Out& out) {
    out.out = state.runs += 1;
    if (tick.activation % 3 == 2) throw std::runtime_error("every third");
  }
};

// A sequence of another length each time.
struct Lengths {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    std::uint32_t salt = 1;
    static constexpr auto fields() { return describe(field<&Param::salt>()); }
  };
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    Sequence<double> out{};
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick& tick, const In&, Out& out) {
    const auto mixed = (static_cast<std::uint64_t>(tick.activation) + p.salt) * 0x9e3779b97f4a7c15ULL;
    out.out.resize((mixed >> 32) % 40 + 1);
  }
};

struct Both {
  static constexpr std::string_view summary = "for tests";
  struct In {
    Sequence<double> a{}, b{};
    static constexpr auto fields() { return describe(field<&In::a>(), field<&In::b>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick&, const In& in, Out& out) { out.out = static_cast<double>(in.a.size() + in.b.size()); }
};

struct Fails {
  static constexpr std::string_view summary = "for tests";
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  static void run(const Tick&, const In&) { throw std::runtime_error("always"); }
};

// Do not end before this is so.
std::atomic<bool> may_end{false};

struct Waits {
  static constexpr std::string_view summary = "for tests";
  static void run(const Tick& tick) {
    while (tick.activation == 3 && !may_end) std::this_thread::yield();
  }
};

Graph graph_of_stages(const std::string& text) {
  static const Registry registry = [] {
    Registry made = tests::generic_tasks();
    made.add(task_class<Lengths>());
    made.add(task_class<Both>());
    made.add(task_class<Fails>());
    made.add(task_class<Waits>());
    return made;
  }();
  return jarol::tests::graph_of(registry, text);
}

Graph mixed_graph() {
  static const Registry registry = [] {
    Registry made = tests::generic_tasks();
    made.add(task_class<Unsteady>());
    return made;
  }();
  std::string tasks, connections;
  for (int i = 0; i < 12; ++i) {
    const std::string n = std::to_string(i);
    tasks += "  u" + n + ": {type: Unsteady, on_fault: " + (i % 2 == 0 ? "hold" : "skip") + "}\n";
    tasks += "  w" + n + ": {type: Window, parameters: {length: " + n + "}}\n";
    tasks += "  m" + n + ": {type: Mean" + (i % 3 == 0 ? ", let: 1ms" : "") + "}\n";
    connections += "  - u" + n + ".out -> w" + n + ".in\n  - w" + n + ".out -> m" + n + ".in\n";
  }
  return tests::graph_of(registry,
                         "graph: t\ntiming: {period: 1ms}\ntasks:\n" + tasks + "connections:\n" + connections);
}
}  // namespace

TEST_SUITE("runtime/stage_team") {
  TEST_CASE("random graphs give the same with 1, 2, 4 and 8 workers") { check_random_graphs(graph_count()); }

  TEST_CASE("on a loaded machine too") {
    const Load load(4);
    check_random_graphs(graph_count() / (tests::is_full() ? 1 : 10));
  }

  TEST_CASE("deep values of two periods reach one heap in the same order for any number of workers") {
    std::uint64_t faults = 0;
    for (int heap = 400; heap <= 800; heap += 48) {
      CAPTURE(heap);
      const Graph graph = graph_of_stages(R"(graph: t
tasks:
  w: {type: Counter, period: 10ms}
  x: {type: Lengths, period: 10ms, heap: 64KiB, parameters: {salt: 1}}
  s: {type: Counter, period: 20ms, let: 20ms}
  y: {type: Lengths, period: 20ms, heap: 64KiB, parameters: {salt: 2}}
  r: {type: Both, period: 20ms, on_fault: hold, heap: )" +
                                          std::to_string(heap) + R"(B}
connections: [w.out -> x.in, s.out -> y.in, x.out -> r.a, y.out -> r.b]
)");
      const Result one = run_with(graph, 1, Sharing::if_it_pays, 4s);
      CHECK(run_with(graph, 2, Sharing::always, 4s) == one);
      faults += one.faults;
    }
    CHECK(faults > 0);
  }

  TEST_CASE("faults of one instant stand in the same order for any number of workers") {
    const Graph graph = graph_of_stages(R"(graph: t
tasks:
  w: {type: Counter, period: 10ms}
  x: {type: Fails, period: 10ms, on_fault: hold}
  l: {type: Counter, period: 20ms, let: 20ms}
  y: {type: Fails, period: 20ms, on_fault: hold}
connections: [w.out -> x.in, l.out -> y.in]
)");
    for (const std::size_t workers : {1, 2, 8}) {
      Executor executor(graph, {}, {.workers = workers, .sharing = Sharing::always});
      executor.run_until(10ms);
      REQUIRE(executor.report().faults.size() == 2);
      CHECK(to_text(executor.report().faults[0]) == "task 'x' activation 0 at 0 s: threw: always");
      CHECK(to_text(executor.report().faults[1]) == "task 'y' activation 0 at 0 s: threw: always");
    }
  }

  TEST_CASE("what does not end is known by name, whichever worker runs it") {
    const Graph graph = graph_of_stages(
        "{graph: t, tasks: {a: {type: Waits, period: 10ms}, b: {type: Waits, period: 10ms}, "
        "c: {type: Counter, period: 10ms}}}");
    Executor executor(graph, {}, {.workers = 3, .sharing = Sharing::always});
    CHECK(executor.running().empty());
    may_end = false;
    std::thread runs([&] { executor.run_until(100ms); });
    std::vector<HangingTask> running;
    for (int i = 0; i < 30'000 && running.size() < 2; ++i, std::this_thread::sleep_for(1ms))
      if (executor.now() == 30ms) running = executor.running();
    may_end = true;
    runs.join();
    std::sort(running.begin(), running.end(), [](const auto& x, const auto& y) { return x.task < y.task; });
    CHECK(running == std::vector{HangingTask{"a", 3, 30ms}, HangingTask{"b", 3, 30ms}});
    CHECK(executor.running().empty());
  }

  TEST_CASE("faults, deep values and records are the same for any number of workers") {
    const Graph graph = mixed_graph();
    const Result one = run_with(graph, 1, Sharing::if_it_pays, 100ms);
    CHECK(one.faults > 100);
    for (const std::size_t workers : counts) CHECK(run_with(graph, workers, Sharing::always, 100ms) == one);

    const auto sorted_trace = [&](std::size_t workers) {
      tests::TraceLines lines(graph);
      Recorder recorder({&lines});
      Executor executor(graph, {},
                        {.digest = false, .recorder = &recorder, .workers = workers, .sharing = Sharing::always});
      executor.run_until(50ms);
      recorder.close();
      std::sort(lines.lines.begin(), lines.lines.end());
      return lines.lines;
    };
    const auto trace = sorted_trace(1);
    CHECK(trace.size() > 1000);
    CHECK(sorted_trace(2) == trace);
    CHECK(sorted_trace(8) == trace);
  }

  TEST_CASE("a stage is shared if its tasks take long enough, and else not") {
    const auto shared_part = [](int count, int rounds) {
      std::string tasks;
      for (int i = 0; i < count; ++i)
        tasks += "  w" + std::to_string(i) + ": {type: Work, parameters: {rounds: " + std::to_string(rounds) + "}}\n";
      const Graph graph = tests::graph_of("graph: t\ntiming: {period: 1ms}\ntasks:\n" + tasks);
      Executor executor(graph, {}, {.digest = true, .recorder = nullptr, .workers = 2});
      executor.run_until(100ms);
      const StageTeam& team = *executor.team();
      CHECK(team.shared() + team.alone() == 100);
      return team.shared();
    };
    CHECK(shared_part(2, 1) == 0);  // far too short, on a slow machine too
    if (std::thread::hardware_concurrency() >= 2) CHECK(shared_part(16, 10'000) == 92);  // all after those that measure
  }
}
