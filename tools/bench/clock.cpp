#include "tools/bench/clock.h"

#include <sys/mman.h>
#include <time.h>

#include <algorithm>
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
constexpr int ticks = 500;  // of a slice

// Adds the lateness of a slice, in microseconds, that so many are below.
void sleep_bare(double part, std::vector<double>& microseconds) {
  std::vector<Duration> lateness;
  lateness.reserve(ticks);
  const Duration start = RealClock::monotonic();
  for (int tick = 1; tick <= ticks; ++tick) {
    const Duration due = start + tick * period;
    const timespec until{due.count() / ns_per_second, due.count() % ns_per_second};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
    lateness.push_back(RealClock::monotonic() - due);
  }
  microseconds.push_back(microseconds_at(part, lateness));
}

// The task reports when it began; activation 0, before which nobody sleeps, does not count.
void run_engine(const Graph& graph, double part, std::vector<double>& microseconds) {
  RealClock clock(graph.tasks.size());
  Executor executor(graph, {}, {.clock = &clock});
  Stamp::clock = &clock;
  Stamp::begun.clear();
  clock.start();
  executor.run_until((ticks + 1) * period);
  std::vector<Duration> lateness(Stamp::begun.begin() + 1, Stamp::begun.end());
  // what was left out, as the one before it was late by a period, was as late
  lateness.resize(ticks, period);
  microseconds.push_back(microseconds_at(part, lateness));
}

}  // namespace

Figure measure_clock(const std::string& name, double part, int repeats) {
  // it goes on however late it is, as the bare loop does
  const Graph graph = graph_of("graph: clock\ntasks:\n  t: {type: Stamp, period: 1ms, on_fault: hold}\n");
  std::vector<double> engine, bare;
  Stamp::begun.reserve(ticks + 1);
  // a thread of its own: the figures after this one keep their timer slack
  std::thread([&] {
    static_cast<void>(RealClock(0).prepare_thread());
    for (int i = 0; i < std::max(8, repeats / 2); ++i) {
      if (i % 2 == 0) sleep_bare(part, bare);
      run_engine(graph, part, engine);
      if (i % 2 == 1) sleep_bare(part, bare);
    }
  }).join();
  munlockall();
  const double value = median_of(engine), floor = median_of(bare);
  return {name,
          value,
          "us",
          floor,
          value / floor,
          1.1,
          "lateness of a task at 1 kHz / of a bare sleeping loop, median of slices of 0.5 s"};
}

}  // namespace jarol::bench
