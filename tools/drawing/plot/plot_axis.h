// Axes of a picture: where a value lies, and where round numbers do.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "graph/language/duration.h"

namespace jarol::tools {

/// Ticks lie at whole multiples of digits * 10^exponent.
struct Ticks {
  std::int64_t digits = 1;
  int exponent = 0;

  double at(std::int64_t i) const;
  std::string label(std::int64_t i) const;
};

/// The narrowest round ticks that split the range into no more than `max` intervals; those of an angle are in degrees.
Ticks find_ticks(double range, int max, bool angle);

struct Axis {
  double min = 0;  // value at the left or bottom
  double max = 1;
  double from = 0;  // px
  double to = 1;
  Ticks ticks;

  double place(double value) const { return from + (to - from) * ((value - min) / (max - min)); }

  template <class Visit>
  void for_each_tick(Visit&& visit) const {
    const double step = ticks.at(1);
    const double slack = 1e-9 * (max - min);
    const auto first = static_cast<std::int64_t>(std::ceil((min - slack) / step));
    const auto last = static_cast<std::int64_t>(std::floor((max + slack) / step));
    for (std::int64_t i = first; i <= last; ++i) visit(place(ticks.at(i)), ticks.label(i));
  }
};

/// Of a run that ends so many ns after its start, over these px.
Axis time_axis(Duration end, double from, double to);

}  // namespace jarol::tools
