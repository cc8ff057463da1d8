// A metric of a run, formed while the run goes on: nothing is kept but a few numbers.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "graph/model/condition.h"
#include "graph/values/archive.h"

namespace jarol {

/// A value holds from its publication to the next one, and counts by how long it holds within the metric's window.
class MetricFold {
 public:
  explicit MetricFold(const expect::Metric& metric) : metric_(metric) {}

  /// The value that held from `from` to before `to`; one after the other.
  void hold(Duration from, Duration to, double value);

  bool has_any() const { return seconds_ > 0; }
  /// None: nothing was in the window, or what is asked for did not happen, and `why_none` says so.
  std::optional<double> result() const;
  std::string why_none() const;

  void serialize(Archive& archive) {
    archive(seconds_, first_, last_, min_, max_, sum_, sum_of_squares_, beyond_, at_tenth_, at_nine_tenths_, settled_);
    archive.require(at_tenth_ || !at_nine_tenths_, "has a step that did not begin");
  }

 private:
  void hold_step(Duration from, Duration to, double value);

  const expect::Metric& metric_;
  double seconds_ = 0;
  double first_ = 0, last_ = 0, min_ = 0, max_ = 0;
  double sum_ = 0, sum_of_squares_ = 0;  // times seconds
  double beyond_ = 0;                    // of the target, in the direction of the step
  std::optional<Duration> at_tenth_, at_nine_tenths_;
  std::optional<Duration> settled_;  // since when it is within the band; none: it is not
};

/// The part of a span that lies in a window; none: `from` is not before `to`.
inline std::pair<Duration, Duration> clip(const expect::Window& window, Duration from, Duration to) {
  return {std::max(from, window.from), window.to ? std::min(to, *window.to) : to};
}

}  // namespace jarol
