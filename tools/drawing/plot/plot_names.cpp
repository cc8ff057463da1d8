#include "tools/drawing/plot/plot_names.h"

#include <algorithm>

namespace jarol::tools {

std::vector<NamedValue> names_in(const std::vector<std::vector<PlotCurve::Point>>& lines, const Type& type) {
  std::vector<NamedValue> names;
  for (const auto& [name, value] : type.enumerators) {
    const auto number = static_cast<double>(value);
    const auto is_it = [&](const PlotCurve::Point& p) { return p.value == number; };
    if (std::any_of(lines.begin(), lines.end(),
                    [&](const auto& points) { return std::any_of(points.begin(), points.end(), is_it); }))
      names.push_back({number, name});
  }
  return names;
}

}  // namespace jarol::tools
