#include "tools/bench/clock.h"

#include <sys/mman.h>
#include <time.h>

#include <memory>
#include <thread>
#include <vector>

#include "runtime/execute/executor.h"
#include "tools/bench/graphs.h"
#include "tools/bench/message.h"
#include "tools/bench/timing.h"

namespace jarol::bench {
namespace {

constexpr std::int64_t ns_per_second = 1'000'000'000;
constexpr Duration period = std::chrono::milliseconds(1);
constexpr int ticks = 25;  // of a slice

using Samples = std::vector<Duration>;

void sleep_bare(Samples& lateness) {
  const Duration start = RealClock::monotonic();
  for (int tick = 1; tick <= ticks; ++tick) {
    const Duration due = start + tick * period;
    const timespec until{due.count() / ns_per_second, due.count() % ns_per_second};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
    lateness.push_back(RealClock::monotonic() - due);
  }
}

// The task reports when it began; activation 0, before which nobody sleeps, does not count.
void run_engine(const Graph& graph, Samples& lateness) {
  RealClock clock(graph.tasks.size());
  Executor executor(graph, {}, {.clock = &clock});
  Stamp::clock = &clock;
  Stamp::begun.clear();
  clock.start();
  executor.run_until((ticks + 1) * period);
  lateness.insert(lateness.end(), Stamp::begun.begin() + 1, Stamp::begun.end());
}

}  // namespace

Figure measure_clock(const std::string& name, double part, int repeats) {
  const Graph graph = graph_of("graph: clock\ntasks:\n  t: {type: Stamp, period: 1ms}\n");
  Samples engine, bare;
  Stamp::begun.reserve(ticks + 1);
  // a thread of its own: the figures after this one keep their timer slack
  std::thread([&] {
    static_cast<void>(RealClock(0).prepare_thread());
    for (int i = 0; i < repeats; ++i) {
      if (i % 2 == 0) sleep_bare(bare);
      run_engine(graph, engine);
      if (i % 2 == 1) sleep_bare(bare);
    }
  }).join();
  munlockall();
  const double value = microseconds_at(part, engine), floor = microseconds_at(part, bare);
  return {name, value, "us", floor, value / floor, 1.1, "lateness of a task at 1 kHz / of a bare sleeping loop"};
}

}  // namespace jarol::bench
