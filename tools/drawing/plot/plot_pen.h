// Writes the shapes and texts of a plot.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/drawing/plot/plot_axis.h"
#include "tools/drawing/plot/plot_curve.h"
#include "tools/drawing/svg.h"

namespace jarol::tools {

/// A colour and px.
struct Stroke {
  std::string_view colour{}, width{}, dashes{};

  void add_to(SvgAttributes& attributes) const;
  bool operator==(const Stroke&) const = default;
};

/// Places are in px from the top left.
class PlotPen {
 public:
  Svg svg;

  void text(double x, double y, std::string_view words, SvgAttributes attributes = {});
  /// Horizontal.
  void line(double x1, double x2, double y, const Stroke& stroke);
  /// Lines on which values are read, at these places.
  void grid(const std::string& path);
  void frame(double left, double right, double top, double height);
  /// Above a panel: what it shows, and more in plain type.
  void heading(double x, double y, std::string_view title, std::string_view more);
  /// Without a filling.
  void path(const std::string& path, const Stroke& stroke);
  /// A held value goes on to `end`; a heading leaves at one edge of the circle and comes back at the other.
  void curve(const PlotCurve& curve, const std::vector<PlotCurve::Point>& points, const Axis& x, const Axis& y,
             const Stroke& stroke, double end);

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
