// What a picture of a run shows beside what was commanded and reached.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "tests/tools/drawing/plot/drawn.h"

namespace {
using namespace jarol;
using namespace jarol::tools;
using namespace jarol::tests;
using namespace std::chrono_literals;

enum class Turning { none, gentle, sharp };
[[maybe_unused]] constexpr auto enumerators(Turning) {
  return std::array{Enumerator<Turning>{"none", Turning::none}, Enumerator<Turning>{"gentle", Turning::gentle},
                    Enumerator<Turning>{"sharp", Turning::sharp}};
}
}  // namespace

TEST_SUITE("tools/plot_beside") {
  TEST_CASE("what is true is a broad line below the others, with its name in the legend") {
    Panel panel{"speed", "", 0, number("speed", "m/s"), std::pair(1U, number("speed", "m/s"))};
    panel.truth = std::pair(2U, number("speed", "m/s"));
    PlotSvg plot("", "", {panel});
    for (std::uint32_t output = 0; output < 3; ++output) {
      take(plot, 0s, output, 0.0);
      take(plot, 1s, output, 1.0 + output);
    }
    const std::string svg = plot.text();
    REQUIRE(strokes(svg, truth).size() == 1);
    const auto place = [&](const std::string& colour) { return svg.find("<path fill=\"none\" stroke=\"" + colour); };
    CHECK(place(truth) < place(reached));
    CHECK(place(reached) < place(commanded));
    CHECK(has(svg, "<text x=\"640\" y=\"69\">true</text>"));
    CHECK(has(svg, "<text x=\"859\" y=\"69\">reached</text>"));
    CHECK(y_of(svg, "3") < y_of(svg, "2"));
  }

  TEST_CASE("an enumerator has its name where it occurs, and numbers do not stand beside it") {
    PlotSvg plot("", "", {{"turn", "", 0, {"", "", 0, &type_of<Turning>()}, {}}});
    const Turning values[] = {Turning::none, Turning::sharp, Turning::none};
    for (int i = 0; i < 3; ++i) plot.take(i * 1s, 0, &values[i]);
    const std::string svg = plot.text();
    CHECK(has(svg, ">none</text>"));
    CHECK(has(svg, ">sharp</text>"));
    CHECK_FALSE(has(svg, "gentle"));
    CHECK(y_of(svg, "sharp") < y_of(svg, "none"));
    CHECK_FALSE(has(svg, "text-anchor=\"end\""));
  }

  TEST_CASE("several values of one kind are lines of one panel, each with a colour and its name") {
    Panel panel{"fins", "rad", 0, number("fins.0", "rad"), {}};
    for (std::uint32_t i = 1; i < 4; ++i) panel.more.emplace_back(i, number("fins." + std::to_string(i), "rad"));
    PlotSvg plot("", "", {panel});
    for (std::uint32_t i = 0; i < 4; ++i) {
      take(plot, 0s, i, 0.0);
      take(plot, 1s, i, 10 * degree * (i + 1));
    }
    const auto other = plot.beside("another");
    const std::string svg = plot.text();
    for (const std::string colour : {"#0072B2", "#D55E00", "#009E73", "#CC79A7"})
      CHECK(strokes(svg, colour).size() == 1);
    for (const std::string name : {"fins.0", "fins.1", "fins.2", "fins.3"}) CHECK(has(svg, ">" + name + "</text>"));
    CHECK_FALSE(has(svg, "another"));
    CHECK(has(svg, "[deg]"));
  }

  TEST_CASE("a path is seen from above, north up and east to the right, a metre as long in both directions") {
    PictureExtras extras;
    extras.path = PathSource{0, {"x", "m", 0, &type_of<double>()}, {"y", "m", sizeof(double), &type_of<double>()}};
    PlotSvg plot("", "", {{"x", "", 0, number("x", "m"), {}}}, extras);
    const double places[][2] = {{0, 0}, {10, 0}, {10, 20}};
    for (int i = 0; i < 3; ++i) plot.take(i * 1s, 0, places[i]);
    const std::string svg = plot.text();
    REQUIRE(strokes(svg, reached).size() == 2);
    // 876 px across and 320 upwards hold 20 m and 10 m with a tenth of air: 29.09 px a metre
    CHECK(strokes(svg, reached).at(1) == "M211.09,581.45L211.09,290.55L792.91,290.55L792.91,290.55");
    CHECK(has(svg, ">start</text>"));
    CHECK(has(svg, ">end</text>"));
    CHECK(has(svg, "east [m], north is up"));
  }

  TEST_CASE("a long path keeps a bounded number of places, and its end") {
    PictureExtras extras;
    extras.path = PathSource{0, {"x", "m", 0, &type_of<double>()}, {"y", "m", sizeof(double), &type_of<double>()}};
    PlotSvg plot("", "", {{"x", "", 0, number("x", "m"), {}}}, extras);
    for (int i = 0; i <= 100'001; ++i) {
      const double place[] = {0.001 * i, std::sin(0.01 * i)};
      plot.take(i * 1ms, 0, place);
    }
    const std::string path = strokes(plot.text(), reached).at(1);
    CHECK(points_in(path) > 500);
    CHECK(points_in(path) < 2100);
    PlotSvg last("", "", {{"x", "", 0, number("x", "m"), {}}}, extras);
    const double nothing[] = {std::nan(""), 0};
    last.take(0s, 0, nothing);
    CHECK_FALSE(has(last.text(), "seen from above"));
  }

  TEST_CASE("what the run differs in stands beside the title") {
    PlotSvg plot("", "dive", {{"a", "", 0, number("a", "m"), {}}}, {.note = "profile at_sea, seed 7"});
    CHECK(has(plot.text(), "<text x=\"940\" y=\"32\" text-anchor=\"end\">profile at_sea, seed 7</text>"));
  }
}
