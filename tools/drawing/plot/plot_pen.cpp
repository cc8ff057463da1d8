#include "tools/drawing/plot/plot_pen.h"

#include <algorithm>

#include "graph/text/escape.h"
#include "tools/drawing/plot/svg_text.h"

namespace jarol::tools {

void PlotPen::text(double x, double y, std::string_view attributes, std::string_view words) {
  svg += "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\"";
  if (!attributes.empty()) svg.append(" ").append(attributes);
  svg.append(">").append(xml_text(words)).append("</text>\n");
}

void PlotPen::line(double x1, double x2, double y, std::string_view stroke) {
  svg.append("<path ").append(stroke).append(" d=\"M" + px(x1) + "," + px(y) + "H" + px(x2) + "\"/>\n");
}

void PlotPen::curve(const PlotCurve& curve, const std::vector<PlotCurve::Point>& points, const Axis& x, const Axis& y,
                    std::string_view stroke, double end) {
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
  svg.append("<path fill=\"none\" ").append(stroke).append(" d=\"" + path_ + "\"/>\n");
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
