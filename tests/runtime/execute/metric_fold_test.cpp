#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "graph/values/seed.h"
#include "runtime/execute/metric_fold.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using expect::Metric;
using expect::Reduction;

// What holds in each millisecond; the oracle looks at these alone.
using Samples = std::vector<double>;

std::optional<double> folded(const Metric& metric, const Samples& samples) {
  MetricFold fold(metric);
  for (std::size_t i = 0, next = 0; i < samples.size(); i = next) {
    while (next < samples.size() && samples[next] == samples[i]) ++next;
    fold.hold(i * 1ms, next * 1ms, samples[i]);
  }
  return fold.result();
}

Samples within(const expect::Window& window, const Samples& samples) {
  Samples inside;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (i * 1ms >= window.from && (!window.to || i * 1ms < *window.to)) inside.push_back(samples[i]);
  return inside;
}

std::optional<double> by_definition(const Metric& m, const Samples& all) {
  const Samples x = within(m.window, all);
  if (x.empty()) return std::nullopt;
  double sum = 0, squares = 0, min = x[0], max = x[0], over = 0;
  for (const double v : x) {
    sum += v, squares += v * v, min = std::min(min, v), max = std::max(max, v);
    over = std::max(over, m.target >= x[0] ? v - m.target : m.target - v);
  }
  const double n = static_cast<double>(x.size());
  const auto first_at = [&](double part) -> std::optional<double> {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::abs(x[i] - x[0]) >= part * std::abs(m.target - x[0]) - 1e-12 && (x[i] - x[0]) * (m.target - x[0]) >= 0 &&
          (x[i] != x[0] || m.target == x[0]))
        return static_cast<double>(i) * 1e-3;
    return std::nullopt;
  };
  switch (m.reduction) {
    case Reduction::final: return x.back();
    case Reduction::min: return min;
    case Reduction::max: return max;
    case Reduction::mean: return sum / n;
    case Reduction::rms: return std::sqrt(squares / n);
    case Reduction::overshoot: return over;
    case Reduction::rise_time:
      if (!first_at(0.9)) return std::nullopt;
      return *first_at(0.9) - *first_at(0.1);
    case Reduction::settling_time: {
      std::size_t i = x.size();
      while (i > 0 && std::abs(x[i - 1] - m.target) <= m.band) --i;
      if (i == x.size()) return std::nullopt;
      return static_cast<double>(i) * 1e-3;
    }
  }
  return std::nullopt;
}

TEST_SUITE("runtime/metric_fold") {
  TEST_CASE("metrics of random values are what their definitions say of every millisecond") {
    std::size_t some = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
      std::uint64_t chance = spread_seed(seed, "metric");
      const auto pick = [&](std::uint64_t n) { return (chance = spread_seed(chance, "next")) % n; };
      Samples samples;
      while (samples.size() < 40) samples.insert(samples.end(), 1 + pick(6), static_cast<double>(pick(9)) - 2);
      Metric metric;
      metric.reduction = static_cast<Reduction>(pick(8));
      metric.target = static_cast<double>(pick(9)) - 2;
      metric.band = static_cast<double>(pick(3));
      if (pick(2) == 0) metric.window.from = pick(50) * 1ms;
      if (pick(2) == 0) metric.window.to = metric.window.from + (1 + pick(30)) * 1ms;
      CAPTURE(seed);
      const auto is = folded(metric, samples), should = by_definition(metric, samples);
      REQUIRE(is.has_value() == should.has_value());
      if (is) CHECK(*is == doctest::Approx(*should).epsilon(1e-9));
      some += is.has_value() ? 1 : 0;
    }
    CHECK(some > 2000);
  }

  TEST_CASE("what is no number stays so in a greatest and a least value, and in an overshoot") {
    for (const Reduction reduction : {Reduction::max, Reduction::min, Reduction::overshoot}) {
      Metric metric;
      metric.reduction = reduction;
      MetricFold fold(metric);
      fold.hold(0ms, 1ms, 1.0);
      fold.hold(1ms, 2ms, std::nan(""));
      fold.hold(2ms, 3ms, 2.0);
      CHECK(std::isnan(*fold.result()));
    }
  }
}
}  // namespace
