// A graph as a drawing: layered from left to right, for pictures and pages.
#include "tools/drawing/graph/layout.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/tools/run_command.h"
#include "tools/commands/run/load_graph.h"
#include "tools/drawing/graph/graph_svg.h"

namespace {
using namespace jarol;
using tools::Drawing;
using tools::DrawnArrow;
using tools::DrawnNode;

Drawing draw(const std::string& file) { return tools::lay_out(*tools::load_without_systems(file, {}).graph); }

const DrawnNode& node(const Drawing& drawing, const std::string& name) {
  for (const DrawnNode& each : drawing.nodes)
    if (each.name == name) return each;
  throw std::invalid_argument("there is no node " + name);
}

std::string overlaps(const Drawing& drawing) {
  std::string found;
  for (const DrawnNode& a : drawing.nodes)
    for (const DrawnNode& b : drawing.nodes)
      if (&a < &b && std::abs(a.x - b.x) < (a.width + b.width) / 2 && std::abs(a.y - b.y) < (a.height + b.height) / 2)
        found += a.name + " and " + b.name + "\n";
  return found;
}
}  // namespace

TEST_SUITE("drawing/layout") {
  TEST_CASE("what feeds stands left of what it feeds, and nothing stands on anything") {
    for (const std::string file : {"specs/exolauv.yaml", "specs/javiator.yaml", "specs/counting.yaml"}) {
      CAPTURE(file);
      const Drawing drawing = draw(file);
      CHECK(overlaps(drawing) == "");
      for (const DrawnNode& n : drawing.nodes) {
        CHECK(n.x - n.width / 2 >= 0);
        CHECK(n.y - n.height / 2 >= 0);
        CHECK(n.x + n.width / 2 <= drawing.width);
        CHECK(n.y + n.height / 2 <= drawing.height);
      }
    }
    const Drawing dive = draw("specs/exolauv.yaml");
    double x = 0;
    for (const char* name : {"from_dune", "navigation", "depth", "fins", "to_dune"}) {
      CHECK(node(dive, name).x > x);
      x = node(dive, name).x;
    }
  }

  TEST_CASE("an arrow begins and ends at its nodes, and stands for all that the one gives the other") {
    const Drawing drawing = draw("specs/javiator.yaml");
    std::size_t connections = 0;
    for (const DrawnArrow& arrow : drawing.arrows) {
      CAPTURE(arrow.text);
      const DrawnNode &from = drawing.nodes[arrow.from], &to = drawing.nodes[arrow.to];
      REQUIRE(arrow.curve.size() >= 4);
      CHECK(arrow.curve.size() % 3 == 1);
      CHECK(arrow.curve.front()[0] == doctest::Approx(from.x + from.width / 2).epsilon(0.02).scale(0));
      CHECK(arrow.curve.front()[1] == doctest::Approx(from.y).epsilon(0.02).scale(0));
      CHECK(arrow.curve.back()[0] == doctest::Approx(to.x - to.width / 2).epsilon(0.02).scale(0));
      CHECK(arrow.curve.back()[1] == doctest::Approx(to.y).epsilon(0.02).scale(0));
      connections += arrow.connections.size();
    }
    CHECK(connections == 38);
  }

  TEST_CASE("distributers stand outside the core, where they send on its left") {
    const Drawing drawing = draw("specs/exolauv.yaml");
    for (const DrawnNode& n : drawing.nodes) {
      const bool within = n.x > drawing.core_x && n.x < drawing.core_x + drawing.core_width && n.y > drawing.core_y &&
                          n.y < drawing.core_y + drawing.core_height;
      CAPTURE(n.name);
      CHECK(within == (n.kind != DrawnNode::Kind::distributer));
    }
    CHECK(node(drawing, "dune").x < drawing.core_x);
  }

  TEST_CASE("the same graph is drawn the same every time") {
    const auto text = [] { return tools::to_svg(draw("specs/javiator.yaml"), "javiator"); };
    CHECK(text() == text());
  }

  TEST_CASE("the picture is XML that needs nothing from elsewhere") {
    const auto svg = command::run_jarol("graph specs/counting.yaml --svg");
    CHECK(svg.exit_code == 0);
    CHECK(svg.output.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 "));
    CHECK(svg.output.ends_with("</svg>\n"));
    CHECK(svg.output.find(">count</text>") != std::string::npos);
    CHECK(svg.output.find("count.out -&gt; slow.in (double)") != std::string::npos);
    CHECK(svg.output.find("http", 40) == std::string::npos);
    CHECK(svg.output.find("<script") == std::string::npos);
  }

  TEST_CASE("an arrow that stands for several connections has a line for each") {
    Drawing drawing;
    drawing.arrows.emplace_back().text = "a.x -> b.x (double)\na.y -> b.y (Motion)";
    CHECK(tools::to_svg(drawing, "t").find("<title>a.x -&gt; b.x (double)\na.y -&gt; b.y (Motion)</title>") !=
          std::string::npos);
  }

  TEST_CASE("names cannot leave the picture's text") {
    Drawing drawing;
    drawing.nodes.push_back({.name = "<b>&\"", .lines = {"]]>"}});
    CHECK(tools::to_svg(drawing, "</title>").find("&lt;b&gt;&amp;") != std::string::npos);
    CHECK(tools::to_svg(drawing, "</title>").find("</title></title>") == std::string::npos);
  }
}
