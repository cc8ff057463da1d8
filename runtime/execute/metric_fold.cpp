#include "runtime/execute/metric_fold.h"

#include <cmath>

namespace jarol {
namespace {
double seconds_of(Duration duration) { return std::chrono::duration<double>(duration).count(); }
}  // namespace

void MetricFold::hold(Duration from, Duration to, double value) {
  std::tie(from, to) = clip(metric_.window, from, to);
  if (from >= to) return;
  if (!has_any()) first_ = min_ = max_ = value;
  last_ = value;
  // what is no number stays visible
  min_ = value < min_ || std::isnan(value) ? value : min_;
  max_ = value > max_ || std::isnan(value) ? value : max_;
  const double seconds = seconds_of(to - from);
  seconds_ += seconds;
  sum_ += value * seconds;
  sum_of_squares_ += value * value * seconds;
  hold_step(from, to, value);
}

// As a step from the first value to the target.
void MetricFold::hold_step(Duration from, Duration, double value) {
  const double height = metric_.target - first_;
  const double part = height == 0 ? 1 : (value - first_) / height;
  if (!at_tenth_ && part >= 0.1) at_tenth_ = from;
  if (!at_nine_tenths_ && part >= 0.9) at_nine_tenths_ = from;
  const double over = height < 0 ? metric_.target - value : value - metric_.target;
  beyond_ = over > beyond_ || std::isnan(over) ? over : beyond_;
  if (!(std::abs(value - metric_.target) <= metric_.band)) {
    settled_.reset();
  } else if (!settled_) {
    settled_ = from;
  }
}

std::optional<double> MetricFold::result() const {
  using expect::Reduction;
  if (!has_any()) return std::nullopt;
  switch (metric_.reduction) {
    case Reduction::final: return last_;
    case Reduction::min: return min_;
    case Reduction::max: return max_;
    case Reduction::mean: return sum_ / seconds_;
    case Reduction::rms: return std::sqrt(sum_of_squares_ / seconds_);
    case Reduction::overshoot: return beyond_;
    case Reduction::rise_time:
      if (!at_nine_tenths_) return std::nullopt;
      return seconds_of(*at_nine_tenths_ - *at_tenth_);
    case Reduction::settling_time:
      if (!settled_) return std::nullopt;
      return seconds_of(*settled_ - metric_.window.from);
  }
  return std::nullopt;
}

std::string MetricFold::why_none() const {
  if (!has_any()) return "was never published";
  return metric_.reduction == expect::Reduction::rise_time ? "did not rise to 90 % of the step" : "had not settled";
}

}  // namespace jarol
