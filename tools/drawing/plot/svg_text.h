// Numbers as they stand in an SVG file.
#pragma once

#include <string>

namespace jarol::tools {

/// Pixels with at most two decimals.
std::string px(double number);

}  // namespace jarol::tools
