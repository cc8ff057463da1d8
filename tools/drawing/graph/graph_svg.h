// A drawing of a graph as SVG, which needs nothing but a program that shows it.
#pragma once

#include <string>

#include "tools/drawing/graph/layout.h"

namespace jarol::tools {

/// `title`: what the graph is called. Colours follow the viewer's choice of light or dark.
std::string to_svg(const Drawing& drawing, const std::string& title);

}  // namespace jarol::tools
