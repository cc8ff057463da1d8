#include "tools/drawing/plot/plot_svg.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tools/drawing/plot/drawn.h"

namespace {
using namespace jarol;
using namespace jarol::tools;
using namespace jarol::tests;
using namespace std::chrono_literals;

// The greatest change of height without lifting the pen, in px.
double longest_stroke(const std::string& path) {
  std::istringstream in(path);
  double longest = 0;
  double before = 0;
  double y = 0;
  double x = 0;
  char comma = 0;
  for (char command = 0; in >> command; before = y) {
    if (command == 'V') in >> y;
    if (command == 'H') in >> x;
    if (command == 'M' || command == 'L') in >> x >> comma >> y;
    if (command != 'M') longest = std::max(longest, std::abs(y - before));
  }
  return longest;
}

}  // namespace

TEST_SUITE("tools/plot_svg") {
  TEST_CASE("a picture is one text without scripts or fonts of its own") {
    PlotSvg plot("", "tiny", {{"speed", "", 0, number("u", "m/s"), {}}});
    take(plot, 0s, 0, 0.0);
    take(plot, 1s, 0, 1.0);
    take(plot, 2s, 0, 1.0);
    CHECK(plot.text() == R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" version="1.1" width="960" height="250" viewBox="0 0 960 250" font-family="Helvetica,Arial,'Liberation Sans','DejaVu Sans',sans-serif" font-size="12" fill="#52606D">
<title>tiny</title>
<rect width="100%" height="100%" fill="#FFFFFF"/>
<text x="64" y="32" font-size="18" font-weight="bold" fill="#1F2933">tiny</text>
<g stroke-linejoin="round" stroke-linecap="round">
<path stroke="#E4E7EB" d="M64,78V202M151.6,78V202M239.2,78V202M326.8,78V202M414.4,78V202M502,78V202M589.6,78V202M677.2,78V202M764.8,78V202M852.4,78V202M940,78V202M64,202H940M64,143.51H940M64,85.02H940"/>
<rect x="64" y="78" width="876" height="124" stroke="#9AA5B1" fill="none"/>
<text x="64" y="69"><tspan font-size="14" font-weight="bold" fill="#1F2933">speed</tspan> [m/s]</text>
<g text-anchor="end">
<text x="56" y="206">0.0</text>
<text x="56" y="147.51">0.5</text>
<text x="56" y="89.02">1.0</text>
</g>
<path fill="none" stroke="#0072B2" stroke-width="2" d="M64,202L502,85.02H940"/>
</g>
<g text-anchor="middle">
<text x="64" y="220">0.0</text>
<text x="151.6" y="220">0.2</text>
<text x="239.2" y="220">0.4</text>
<text x="326.8" y="220">0.6</text>
<text x="414.4" y="220">0.8</text>
<text x="502" y="220">1.0</text>
<text x="589.6" y="220">1.2</text>
<text x="677.2" y="220">1.4</text>
<text x="764.8" y="220">1.6</text>
<text x="852.4" y="220">1.8</text>
<text x="940" y="220">2.0</text>
<text x="502" y="239">time [s]</text>
</g>
</svg>
)");
  }

  TEST_CASE("the same input gives the same bytes") {
    std::string texts[2];
    for (std::string& text : texts) {
      PlotSvg plot("", "twice", {{"a", "", 0, number("a", "m"), {}}});
      for (int i = 0; i < 5000; ++i) take(plot, i * 10ms, 0, 0.1 * (i % 77));
      text = plot.text();
    }
    CHECK(texts[0] == texts[1]);
  }

  TEST_CASE("depth grows downwards, also as z in metres; other values grow upwards") {
    const auto picture = [](const std::string& title, const Leaf& leaf) {
      PlotSvg plot("", "", {{title, "", 0, leaf, {}}});
      take(plot, 0s, 0, 0.0);
      take(plot, 1s, 0, 20.0);
      return plot.text();
    };
    for (const std::string& svg : {picture("a", number("eta.depth", "m")), picture("a", number("position.z", "m")),
                                   picture("Depth", number("", "m"))})
      CHECK(y_of(svg, "20") > y_of(svg, "10"));
    for (const std::string& svg : {picture("a", number("x", "m")), picture("a", number("z", "N"))})
      CHECK(y_of(svg, "20") < y_of(svg, "10"));
  }

  TEST_CASE("angles are shown in degrees") {
    PlotSvg plot("", "", {{"pitch", "", 0, number("theta", "rad"), {}}, {"rate", "rad/s", 0, number("q", ""), {}}});
    take(plot, 0s, 0, 0.0);
    take(plot, 1s, 0, 10 * degree);
    const std::string svg = plot.text();
    CHECK(has(svg, ">pitch</tspan> [deg]</text>"));
    CHECK(has(svg, ">rate</tspan> [deg/s]</text>"));
    CHECK(y_of(svg, "10") < y_of(svg, "0"));
    CHECK_FALSE(has(svg, "rad"));
  }

  TEST_CASE("what was commanded is a dashed step line up to the end, with a legend") {
    PlotSvg plot("", "", {{"speed", "", 0, number("u", "m/s"), std::pair(1U, number("speed", "m/s"))}});
    take(plot, 0s, 0, 0.0);
    take(plot, 4s, 0, 10.0);
    take(plot, 0s, 1, 0.0);
    for (const auto instant : {1s, 2s, 3s}) take(plot, instant, 1, 10.0);
    const std::string svg = plot.text();
    // from 0 to 4 s there are 876 px; a line goes straight, a step first ahead
    CHECK(strokes(svg, reached) == std::vector<std::string>{"M64,202L940,85.02"});
    CHECK(strokes(svg, commanded) == std::vector<std::string>{"M64,202H283V85.02H940"});
    CHECK(has(svg, "stroke-dasharray"));
    CHECK(has(svg, ">commanded</text>"));
    CHECK(has(svg, ">reached</text>"));
  }

  TEST_CASE("a heading leaves at one edge and comes back at the other") {
    PlotSvg plot("", "", {{"heading", "", 0, number("psi", "rad"), std::pair(1U, number("heading", "rad"))}});
    take(plot, 0s, 0, 170 * degree);
    take(plot, 2s, 0, -170 * degree);
    take(plot, 0s, 1, 90 * degree);
    take(plot, 1s, 1, 270 * degree);  // -90
    const std::string svg = plot.text();
    CHECK(strokes(svg, reached) == std::vector<std::string>{"M64,81.44L502,78M502,202L940,198.56"});
    CHECK(strokes(svg, commanded) == std::vector<std::string>{"M64,109H502V171H940"});
    CHECK(has(svg, ">\u2212180</text>"));
  }

  TEST_CASE("other angles that jump by more than half a turn are broken") {
    PlotSvg plot("", "", {{"roll", "", 0, number("phi", "rad"), {}}});
    const double degrees[] = {150, 179, -179, -150};
    for (int i = 0; i < 4; ++i) take(plot, i * 1s, 0, degrees[i] * degree);
    const std::string path = strokes(plot.text(), reached).at(0);
    CHECK(std::count(path.begin(), path.end(), 'M') == 2);
  }

  TEST_CASE("a long run takes at most 2000 points a curve and keeps its extremes") {
    PlotSvg plot("", "", {{"a", "", 0, number("a", "N"), {}}});
    for (int i = 0; i < 300'000; ++i)
      take(plot, i * 1ms, 0, i == 123'457 ? 9.0 : i == 222'222 ? -9.0 : (i % 1000 * 7919 % 1000) * 1e-3);
    const std::string svg = plot.text();
    const std::string path = strokes(svg, reached).at(0);
    CHECK(points_in(path) <= 2000);
    CHECK(points_in(path) > 1000);
    // 6 % of air on either side of -9 to 9
    CHECK(has(path, ",84.64"));
    CHECK(has(path, ",195.36"));
  }

  TEST_CASE("an angle that wraps often in a long run is never a vertical stroke") {
    PlotSvg plot("", "", {{"heading", "", 0, number("psi", "rad"), {}}});
    for (int i = 0; i < 200'000; ++i) take(plot, i * 10ms, 0, std::remainder(i * 1e-3, 2 * std::numbers::pi));
    const std::string path = strokes(plot.text(), reached).at(0);
    CHECK(longest_stroke(path) < 10);                        // px; from edge to edge there are 124
    CHECK(std::count(path.begin(), path.end(), 'M') == 33);  // 200 rad are 31.8 turns
  }

  TEST_CASE("without data a panel says so") {
    PlotSvg plot("", "", {{"a", "m", 0, number("a", "m"), std::pair(1U, number("a", "m"))}});
    CHECK(has(plot.text(), ">no data</text>"));
    CHECK(has(PlotSvg("", "", {}).text(), ">no data</text>"));
  }

  TEST_CASE("what is no finite number is left out") {
    PlotSvg plot("", "", {{"a", "", 0, number("a", ""), {}}});
    using Limits = std::numeric_limits<double>;
    const double values[] = {1.0, Limits::quiet_NaN(), Limits::infinity(), -Limits::max(), 2.0};
    for (int i = 0; i < 5; ++i) take(plot, i * 1s, 0, values[i]);
    const std::string svg = plot.text();
    CHECK(points_in(strokes(svg, reached).at(0)) == 2);
    CHECK_FALSE(has(svg, "nan"));
    CHECK_FALSE(has(svg, "inf"));
  }

  TEST_CASE("constant, single and tiny values have an axis of round ticks") {
    const auto picture = [](double first, double second) {
      PlotSvg plot("", "", {{"a", "", 0, number("a", ""), {}}});
      take(plot, 0s, 0, first);
      take(plot, 1s, 0, second);
      return plot.text();
    };
    CHECK(has(picture(0, 0), ">0.5</text>"));
    CHECK(has(picture(3, 3), ">3.0</text>"));
    CHECK(has(picture(-2e-9, 2e-9), ">\u22122e-9</text>"));
    CHECK(has(picture(0, 4e9), ">4e9</text>"));
    PlotSvg plot("", "", {{"a", "", 0, number("a", ""), {}}});
    take(plot, 0s, 0, 1.0);
    CHECK(strokes(plot.text(), reached) == std::vector<std::string>{"M64,140h0"});
  }

  TEST_CASE("truth values and durations are drawn too") {
    const bool armed[] = {false, true};
    const Duration age[] = {0ms, 1500ms};
    PlotSvg plot(
        "", "",
        {{"armed", "", 0, {"", "", 0, &type_of<bool>()}, {}}, {"age", "", 1, {"", "", 0, &type_of<Duration>()}, {}}});
    for (int i = 0; i < 2; ++i) {
      plot.take(i * 1s, 0, &armed[i]);
      plot.take(i * 1s, 1, &age[i]);
    }
    const std::string svg = plot.text();
    CHECK(strokes(svg, reached).at(0) == "M64,202H940V85.02");
    CHECK(has(svg, ">age</tspan> [s]</text>"));
    CHECK(has(svg, ">1.5</text>"));
  }

  TEST_CASE("texts are escaped") {
    PlotSvg plot("", "a<b & \"c\"", {{"x>\n", "<m>", 0, number("x", "m"), {}}});
    const std::string svg = plot.text();
    CHECK(has(svg, "<title>a&lt;b &amp; &quot;c&quot;</title>"));
    CHECK(has(svg, ">x&gt;\\n</tspan> [&lt;m&gt;]</text>"));
  }

  TEST_CASE("outputs without a panel are passed over, yet the axis reaches to their last instant") {
    PlotSvg plot("", "", {{"a", "", 0, number("a", "m"), {}}});
    take(plot, 0s, 0, 1.0);
    take(plot, 50s, 9, 7.0);
    CHECK(has(plot.text(), ">50</text>"));
    take(plot, 99'980ms, 9, 7.0);
    CHECK(has(plot.text(), "<text x=\"940\" y=\"220\">100</text>"));
  }

  TEST_CASE("the file is written whole at the end") {
    const auto path = std::filesystem::temp_directory_path() / "jarol_plot_test.svg";
    std::filesystem::remove(path);
    PlotSvg plot(path.string(), "t", {{"a", "", 0, number("a", "m"), {}}});
    take(plot, 0s, 0, 1.0);
    CHECK_FALSE(std::filesystem::exists(path));
    plot.finish();
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    CHECK(text.str() == plot.text());
    std::filesystem::remove(path);
  }

  TEST_CASE("a file that can't be written is an error with its reason") {
    PlotSvg absent("/no/such/folder/a.svg", "t", {});
    CHECK_THROWS_WITH_AS(absent.finish(), "can't write '/no/such/folder/a.svg': No such file or directory",
                         std::runtime_error);
    // a folder stands where the file should
    const auto folder = std::filesystem::temp_directory_path() / "jarol_plot_test_folder.svg";
    std::filesystem::create_directory(folder);
    PlotSvg covered(folder.string(), "t", {});
    const std::string message = "can't write '" + folder.string() + "': Is a directory";
    CHECK_THROWS_WITH_AS(covered.finish(), message.c_str(), std::runtime_error);
    std::filesystem::remove(folder);
  }
}
