// What `check` says holds, run on the real clock with every task at its WCET.
#include <doctest/doctest.h>

#include <ctime>
#include <numeric>

#include "graph/analysis/check.h"
#include "tests/graph/analysis/random_sets.h"
#include "tests/how_many.h"
#include "tests/runtime/run_on_threads.h"

namespace {
using namespace jarol;
using namespace jarol::tests::threads;

std::int64_t processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

// Takes so much time of its processor.
struct Burn {
  Duration lasts{};
  static constexpr auto fields() { return describe(field<&Burn::lasts>()); }
  void now() const {
    const std::int64_t end = processor_time() + lasts.count();
    while (processor_time() < end) {}
  }
};

struct Sum {
  double out = 0;
  static constexpr auto fields() { return describe(field<&Sum::out>()); }
};

struct Burn0 {
  static constexpr std::string_view summary = "for tests";
  using Param = Burn;
  using Out = Sum;
  static void run(const Param& p, const Tick&, Out& out) {
    p.now();
    out.out += 1;
  }
};

struct Burn1 {
  static constexpr std::string_view summary = "for tests";
  using Param = Burn;
  using Out = Sum;
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  static void run(const Param& p, const Tick&, const In& in, Out& out) {
    p.now();
    out.out += in.in;
  }
};

struct Burn2 {
  static constexpr std::string_view summary = "for tests";
  using Param = Burn;
  using Out = Sum;
  struct In {
    double a = 0, b = 0;
    static constexpr auto fields() { return describe(field<&In::a>(), field<&In::b>()); }
  };
  static void run(const Param& p, const Tick&, const In& in, Out& out) {
    p.now();
    out.out += in.a + in.b;
  }
};

Graph burning_graph(const std::string& text) {
  static const Registry registry = [] {
    Registry made;
    analysis::add_policies(made);
    made.add(task_class<Burn0>());
    made.add(task_class<Burn1>());
    made.add(task_class<Burn2>());
    return made;
  }();
  return jarol::tests::graph_of(registry, text);
}

// One in ten of a WCET is left for what the clock and the threads take, which weighs less the slower it runs.
std::string burning_text(const truth::Set& set) {
  return truth::yaml_of(set, "ms", [](const truth::Task& task, std::size_t inputs) {
    return "Burn" + std::to_string(inputs) + ", parameters: {lasts: " + std::to_string(900 * task.wcet) + "us}";
  });
}

// The next set of two cores, both in use, that `check` says yes to, not far from a no.
truth::Set next_yes(std::uint64_t& seed, const Policy& policy) {
  while (true) {
    const truth::Set set =
        truth::random_set(++seed, policy, {.jitter = false, .blocking = false, .any_phasing = false});
    const analysis::Result said = analysis::check(truth::graph_of(set));
    if (set.cores != 2 || said.verdict != analysis::Verdict::schedulable || said.utilisation < 1) continue;
    if (std::all_of(said.core.begin(), said.core.end(), [&](const auto& c) { return c == said.core[0]; })) continue;
    return set;
  }
}
}  // namespace

TEST_SUITE("runtime/real_yes") {
  TEST_CASE("a run with every task at its WCET never contradicts a yes") {
    if (machine().fifo_priority < 60 || machine().usable.size() < 2) {
      MESSAGE("this machine does not permit SCHED_FIFO, or has one processor");
      return;
    }
    RealTimeOptions options = undisturbed();
    options.core_cpus = {machine().usable[0], machine().usable[1]};
    const int count = tests::how_many(4, 100);
    for (const Policy& policy : {policies::table, policies::fixed_priority}) {
      std::uint64_t seed = 0;
      for (int i = 0; i < count; ++i) {
        const truth::Set set = next_yes(seed, policy);
        const std::string text = burning_text(set);
        CAPTURE(text);
        std::int64_t hyperperiod = 1;
        for (const truth::Task& t : set.tasks) hyperperiod = std::lcm(hyperperiod, std::int64_t{t.period});
        std::string misses;
        const bool held = tests::at_some_speed([&](int times) {
          misses = tests::misses_of(
              run(burning_graph(tests::slowed(text, times)), 3 * hyperperiod * 1ms, times, options).report);
          return misses.empty();
        });
        CAPTURE(misses);
        CHECK(held);
      }
    }
  }
}
