// One curve of a picture: a bounded number of extremes is kept, however many samples come.
#pragma once

#include <cstdint>
#include <vector>

#include "graph/language/duration.h"
#include "graph/values/bind.h"

namespace jarol::tools {

struct PlotCurve {
  static constexpr double max_value = 1e300;  // what lies beyond can't be scaled without overflow

  struct Point {
    Duration instant{};
    double value = 0;       // in the unit shown
    std::int64_t turn = 0;  // whole turns that make a wrapped angle continuous again
  };
  // What is kept of consecutive samples.
  struct Span {
    Point low;
    Point high;
    Point last;
    void widen(const Span& next);
  };

  Leaf leaf;
  double factor = 1;     // from the value's unit to the one shown
  bool angle = false;    // in degrees
  bool heading = false;  // shown from -180 to 180
  bool held = false;     // drawn as steps
  std::vector<Span> spans;
  std::uint64_t samples_per_span = 1;
  std::uint64_t samples_in_last = 0;

  /// Adds what the leaf reads in a published value.
  void add(Duration instant, const void* output);

  /// At most about 2000 points of a run that ends at `end`.
  std::vector<Point> points(Duration end) const;
};

}  // namespace jarol::tools
