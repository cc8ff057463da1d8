// What stands in a picture of a run.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "graph/values/type_of.h"
#include "tools/drawing/plot/plot_svg.h"

namespace jarol::tests {
using tools::PlotSvg;

inline constexpr double degree = std::numbers::pi / 180.0;

inline Leaf number(const std::string& path, const std::string& unit) { return {path, unit, 0, &type_of<double>()}; }

inline void take(PlotSvg& plot, Duration instant, std::uint32_t output, double value) {
  plot.take(instant, output, &value);
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// The d="..." of all strokes in that colour, the legend's left out.
inline std::vector<std::string> strokes(const std::string& svg, const std::string& colour) {
  std::vector<std::string> found;
  for (std::size_t at = 0; (at = svg.find("<path fill=\"none\" stroke=\"" + colour, at)) != std::string::npos; ++at) {
    const std::size_t begin = svg.find(" d=\"", at) + 4;
    found.push_back(svg.substr(begin, svg.find('"', begin) - begin));
  }
  return found;
}
inline const std::string reached = "#0072B2";
inline const std::string commanded = "#D55E00";
inline const std::string truth = "#B8C1CC";

inline std::size_t points_in(const std::string& path) {
  return static_cast<std::size_t>(std::count_if(path.begin(), path.end(), [](char c) { return c >= 'A' && c <= 'Z'; }));
}

// Where the text stands, in px from the top.
inline double y_of(const std::string& svg, const std::string& text) {
  const std::size_t end = svg.find("\">" + text + "</text>");
  REQUIRE(end != std::string::npos);
  return std::stod(svg.substr(svg.rfind("y=\"", end) + 3));
}

}  // namespace jarol::tests
