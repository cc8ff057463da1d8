#include "tools/drawing/plot/plot_axis.h"

#include <cstdlib>

namespace jarol::tools {
namespace {

double ten_to(int exponent) {
  double power = 1;
  for (int i = 0; i < std::abs(exponent); ++i) power *= 10;
  return power;
}

}  // namespace

double Ticks::at(std::int64_t i) const {
  const auto number = static_cast<double>(i * digits);
  return exponent < 0 ? number / ten_to(exponent) : number * ten_to(exponent);
}

std::string Ticks::label(std::int64_t i) const {
  std::string text = std::to_string(std::abs(i * digits));
  if (exponent < -6 || exponent > 6) {
    if (i != 0) text += "e" + std::to_string(exponent);
  } else if (exponent < 0) {
    const auto places = static_cast<std::size_t>(-exponent);
    if (text.size() <= places) text.insert(0, places + 1 - text.size(), '0');
    text.insert(text.size() - places, ".");
  } else if (i != 0) {
    text.append(static_cast<std::size_t>(exponent), '0');
  }
  return i < 0 ? "\u2212" + text : text;
}

Ticks find_ticks(double range, int max, bool angle) {
  const double min = range / max;
  if (angle && min > 10)
    for (const int step : {15, 30, 45, 90, 180, 360})
      if (step >= min) return {step, 0};
  int exponent = -308;
  while (Ticks{5, exponent}.at(1) < min) ++exponent;
  for (const int digits : {1, 2})
    if (Ticks{digits, exponent}.at(1) >= min) return {digits, exponent};
  return {5, exponent};
}

Axis time_axis(Duration end, double from, double to) {
  const double seconds = end > Duration{} ? static_cast<double>(end.count()) * 1e-9 : 1.0;
  Axis axis{0, seconds, from, to, find_ticks(seconds, 12, false)};
  // a run of 100 s ends at 99.98 s: the tick it just misses belongs to it
  const double next = axis.ticks.at(static_cast<std::int64_t>(std::ceil(seconds / axis.ticks.at(1))));
  if (next < 1.01 * seconds) axis.max = next;
  return axis;
}

}  // namespace jarol::tools
