// Durations counted in buckets that widen with what they hold, so that percentiles cost no memory per sample.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "graph/language/duration.h"

namespace jarol {

class Histogram {
 public:
  /// A negative one counts as zero.
  void add(Duration duration) {
    const auto value = static_cast<std::uint64_t>(std::max(duration, Duration{}).count());
    ++counts_[bucket_of(value)];
    ++count_;
    if (value > max_) max_ = value;
  }

  std::uint64_t count() const { return count_; }
  Duration max() const { return of(max_); }

  /// The least duration that at least this part of all does not exceed, rounded up by at most 1/16; 0 if there is none.
  Duration percentile(double part) const {
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      below += counts_[i];
      if (below > 0 && static_cast<double>(below) >= part * static_cast<double>(count_))
        return of(std::min(upper_end(i), max_));
    }
    return max();
  }

 private:
  static constexpr unsigned detail = 4;  // bits kept below the leading one
  static constexpr std::size_t parts = std::size_t{1} << detail;

  static Duration of(std::uint64_t ns) { return Duration(static_cast<std::int64_t>(ns)); }

  // up to 2 * parts exact; above by leading bit and the `detail` bits after it
  static std::size_t bucket_of(std::uint64_t value) {
    if (value < 2 * parts) return static_cast<std::size_t>(value);
    const unsigned shift = static_cast<unsigned>(std::bit_width(value)) - detail - 1;
    return shift * parts + static_cast<std::size_t>(value >> shift);
  }
  static std::uint64_t upper_end(std::size_t bucket) {
    if (bucket < 2 * parts) return bucket;
    const std::size_t shift = bucket / parts - 1;
    return ((static_cast<std::uint64_t>(bucket % parts + parts) + 1) << shift) - 1;
  }

  std::array<std::uint64_t, (64 - detail + 1) * parts> counts_{};
  std::uint64_t count_ = 0;
  std::uint64_t max_ = 0;
};

}  // namespace jarol
