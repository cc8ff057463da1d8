// The enumerators that occur in the curves of a picture.
#pragma once

#include <string>
#include <vector>

#include "tools/drawing/plot/plot_curve.h"

namespace jarol::tools {

struct NamedValue {
  double value = 0;
  std::string name;
};

/// Those of an enumeration that some point has, as the type lists them.
std::vector<NamedValue> names_in(const std::vector<std::vector<PlotCurve::Point>>& lines, const Type& type);

}  // namespace jarol::tools
