#include "tools/bench/clock.h"

#include <sys/mman.h>
#include <time.h>

#include <algorithm>
#include <optional>
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

double lateness_of_sleep(double part) {
  std::vector<Duration> lateness;
  lateness.reserve(ticks);
  const Duration start = RealClock::monotonic();
  for (int tick = 1; tick <= ticks; ++tick) {
    const Duration due = start + tick * period;
    const timespec until{due.count() / ns_per_second, due.count() % ns_per_second};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
    lateness.push_back(RealClock::monotonic() - due);
  }
  return microseconds_at(part, lateness);
}

}  // namespace

double lateness_of_run(const Graph& graph, double part, RecordSink* sink) {
  RealClock clock(graph.tasks.size());
  std::optional<Recorder> recorder;
  if (sink != nullptr) recorder.emplace(std::vector{sink}, std::chrono::milliseconds(20));
  Executor executor(graph, {}, {.recorder = recorder ? &*recorder : nullptr, .clock = &clock});
  Stamp::clock = &clock;
  Stamp::begun.clear();
  Stamp::begun.reserve(ticks + 1);
  clock.start();
  executor.run_until((ticks + 1) * period);
  if (recorder) recorder->close();
  // before activation 0 nobody sleeps
  std::vector<Duration> lateness(Stamp::begun.begin() + 1, Stamp::begun.end());
  // what was left out, as the one before it was late by a period, was as late
  lateness.resize(ticks, period);
  return microseconds_at(part, lateness);
}

Figure compare_lateness(std::string name, std::string text, double goal, int repeats,
                        const std::function<double()>& value, const std::function<double()>& floor) {
  Figure figure;
  // a thread of its own: the figures after this one keep their timer slack
  std::thread([&] {
    static_cast<void>(RealClock(0).prepare_thread());
    figure = compare_medians(std::move(name), std::move(text) + ", median of slices of 0.5 s", goal,
                             std::max(8, repeats / 2), value, floor);
  }).join();
  munlockall();
  figure.unit = "us";
  return figure;
}

Figure measure_clock(const std::string& name, double part, int repeats) {
  // it goes on however late it is, as the bare loop does
  const Graph graph = graph_of("graph: clock\ntasks:\n  t: {type: Stamp, period: 1ms, on_fault: hold}\n");
  return compare_lateness(
      name, "lateness of a task at 1 kHz / of a bare sleeping loop", 1.1, repeats,
      [&] { return lateness_of_run(graph, part); }, [&] { return lateness_of_sleep(part); });
}

}  // namespace jarol::bench
