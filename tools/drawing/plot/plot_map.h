// Where a vehicle went, seen from above.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "graph/values/bind.h"
#include "tools/drawing/plot/plot_pen.h"

namespace jarol::tools {

/// Leaves of one output, in m to the north and to the east.
struct PathSource {
  std::uint32_t output = 0;
  Leaf north, east;
};

/// North is up, and a metre as long in both directions.
class PlotMap {
 public:
  static constexpr double height = 320;  // px, of the panel

  /// A bounded number of places in equal distances of time, however long the run.
  class Path {
   public:
    Path(PathSource source, std::string name, const Stroke& stroke);
    void take(std::uint32_t output, const void* value);

   private:
    friend class PlotMap;
    struct Place {
      double north = 0, east = 0;
    };

    PathSource source_;
    std::string name_;
    Stroke stroke_;
    std::vector<Place> places_;
    Place last_;
    std::uint64_t taken_ = 0, step_ = 1;
  };

  /// The paths outlive it.
  explicit PlotMap(const std::vector<Path>& paths);

  /// Nothing was taken.
  bool is_empty() const;
  void draw(double left, double right, double top, PlotPen& pen) const;

 private:
  const std::vector<Path>& paths_;
};

}  // namespace jarol::tools
