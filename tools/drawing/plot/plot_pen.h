// Writes the shapes and texts of a plot.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/drawing/plot/plot_axis.h"
#include "tools/drawing/plot/plot_curve.h"

namespace jarol::tools {

/// Places are in px from the top left.
class PlotPen {
 public:
  std::string svg;

  void text(double x, double y, std::string_view attributes, std::string_view words);
  /// Horizontal.
  void line(double x1, double x2, double y, std::string_view stroke);
  /// A held value goes on to `end`; a heading leaves at one edge of the circle and comes back at the other.
  void curve(const PlotCurve& curve, const std::vector<PlotCurve::Point>& points, const Axis& x, const Axis& y,
             std::string_view stroke, double end);

 private:
  void start(double x, double y);
  void go_on(double x, double y);
  void end_level();
  void end_stroke();

  std::string path_;
  std::string x_;  // where the pen is
  std::string y_;
  bool level_ = false;  // a horizontal run is still to be written
  bool moved_ = true;
};

}  // namespace jarol::tools
