#include "tools/bench/timing.h"

#include <algorithm>
#include <chrono>

#include "tools/bench/graphs.h"

namespace jarol::bench {

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double microseconds_at(double part, std::vector<Duration>& samples) {
  const auto at = samples.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(samples.size() - 1));
  std::nth_element(samples.begin(), at, samples.end());
  return 1e-3 * static_cast<double>(at->count());
}

void keep(double result) { asm volatile("" : : "g"(&result) : "memory"); }

GraphRun::GraphRun(const std::string& text, bool digest, Duration slice, std::size_t workers)
    : graph_(graph_of(text)),
      executor_(graph_, {}, {.digest = digest, .recorder = nullptr, .workers = workers}),
      slice_(slice) {}

double GraphRun::nanoseconds() {
  const std::uint64_t before = executor_.report().activations;
  until_ += slice_;
  const double seconds = seconds_of([&] { executor_.run_until(until_); });
  return 1e9 * seconds / static_cast<double>(executor_.report().activations - before);
}

Figure compare(std::string name, std::string text, double goal, int repeats, const std::function<double()>& value,
               const std::function<double()>& floor) {
  Figure figure{std::move(name), 1e300, "ns", 1e300, 0, goal, std::move(text)};
  value();
  floor();
  for (int i = 0; i < repeats; ++i) {
    figure.floor = std::min(figure.floor, floor());
    figure.value = std::min(figure.value, value());
  }
  figure.ratio = figure.value / figure.floor;
  return figure;
}

Figure compare_medians(std::string name, std::string text, double goal, int repeats,
                       const std::function<double()>& value, const std::function<double()>& floor) {
  std::vector<double> values, floors;
  value();
  floor();
  for (int i = 0; i < repeats; ++i) {
    floors.push_back(floor());
    values.push_back(value());
  }
  const auto median = [](std::vector<double>& of) {
    std::nth_element(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2), of.end());
    return of[of.size() / 2];
  };
  const double v = median(values), f = median(floors);
  return {std::move(name), v, "ns", f, v / f, goal, std::move(text)};
}

}  // namespace jarol::bench
