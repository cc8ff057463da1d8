#include "tools/drawing/plot/plot_pen.h"

#include <algorithm>

namespace jarol::tools {

void Stroke::add_to(SvgAttributes& attributes) const {
  attributes.push_back({"stroke", std::string(colour)});
  attributes.push_back({"stroke-width", std::string(width)});
  if (!dashes.empty()) attributes.push_back({"stroke-dasharray", std::string(dashes)});
}

void PlotPen::text(double x, double y, std::string_view words, SvgAttributes attributes) {
  attributes.insert(attributes.begin(), {{"x", px(x)}, {"y", px(y)}});
  svg.element("text", attributes, words).line_end();
}

void PlotPen::line(double x1, double x2, double y, const Stroke& stroke) {
  SvgAttributes attributes;
  stroke.add_to(attributes);
  attributes.push_back({"d", "M" + px(x1) + "," + px(y) + "H" + px(x2)});
  svg.element("path", attributes).line_end();
}

void PlotPen::grid(const std::string& path) { svg.element("path", {{"stroke", "#E4E7EB"}, {"d", path}}).line_end(); }

void PlotPen::frame(double left, double right, double top, double height) {
  svg.element("rect", {{"x", px(left)},
                       {"y", px(top)},
                       {"width", px(right - left)},
                       {"height", px(height)},
                       {"stroke", "#9AA5B1"},
                       {"fill", "none"}});
  svg.line_end();
}

void PlotPen::heading(double x, double y, std::string_view title, std::string_view more) {
  svg.begin("text", {{"x", px(x)}, {"y", px(y)}});
  svg.element("tspan", {{"font-size", "14"}, {"font-weight", "bold"}, {"fill", "#1F2933"}}, title);
  svg.words(more).end().line_end();
}

void PlotPen::path(const std::string& path, const Stroke& stroke) {
  SvgAttributes attributes{{"fill", "none"}};
  stroke.add_to(attributes);
  attributes.push_back({"d", path});
  svg.element("path", attributes).line_end();
}

void PlotPen::curve(const PlotCurve& curve, const std::vector<PlotCurve::Point>& points, const Axis& x, const Axis& y,
                    const Stroke& stroke, double end) {
  path_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PlotCurve::Point& b = points[i];
    const double x_b = x.place(static_cast<double>(b.instant.count()) * 1e-9);
    const double y_b = y.place(b.value);
    if (i == 0) {
      start(x_b, y_b);
      continue;
    }
    const PlotCurve::Point& a = points[i - 1];
    if (curve.held) go_on(x_b, y.place(a.value));
    if (a.turn == b.turn) {
      go_on(x_b, y_b);
      continue;
    }
    if (curve.heading && !curve.held) {
      // leave at one edge of the circle and come back at the other
      const double edge = b.turn > a.turn ? 180.0 : -180.0;
      const double way = b.value - a.value + 2 * edge;
      const double part = way == 0 ? 0.0 : std::clamp((edge - a.value) / way, 0.0, 1.0);
      const double x_a = x.place(static_cast<double>(a.instant.count()) * 1e-9);
      const double x_edge = x_a + part * (x_b - x_a);
      go_on(x_edge, y.place(edge));
      start(x_edge, y.place(-edge));
      go_on(x_b, y_b);
    } else {
      start(x_b, y_b);
    }
  }
  if (curve.held) go_on(end, y.place(points.back().value));
  end_stroke();
  path(path_, stroke);
}

void PlotPen::start(double x, double y) {
  end_stroke();
  path_ += "M" + px(x) + "," + px(y);
  x_ = px(x);
  y_ = px(y);
  moved_ = false;
}

// runs along an axis are merged: steps and settled values cost few bytes
void PlotPen::go_on(double x, double y) {
  const std::string to_x = px(x);
  const std::string to_y = px(y);
  if (to_x == x_ && to_y == y_) return;
  if (to_y != y_ && level_) end_level();
  if (to_y == y_) {
    level_ = true;
  } else if (to_x == x_) {
    path_ += "V" + to_y;
  } else {
    path_ += "L" + to_x + "," + to_y;
  }
  x_ = to_x;
  y_ = to_y;
  moved_ = true;
}

void PlotPen::end_level() {
  path_ += "H" + x_;
  level_ = false;
}

// a stroke without length is a dot, thanks to its round ends
void PlotPen::end_stroke() {
  if (level_) end_level();
  if (!moved_ && !path_.empty()) path_ += "h0";
  moved_ = true;
}

}  // namespace jarol::tools
