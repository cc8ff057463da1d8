// Numbers and words as they stand in an SVG file.
#pragma once

#include <string>
#include <string_view>

namespace jarol::tools {

/// Pixels with at most two decimals.
std::string px(double number);

std::string escaped(std::string_view text);

}  // namespace jarol::tools
