#include "tools/drawing/graph/graph_svg.h"

#include <sstream>

#include "tools/drawing/svg.h"

namespace jarol::tools {
namespace {

constexpr const char* style = R"(svg{font-family:sans-serif;background:#fff;color:#1c2430}
.core{fill:#f7f9fc;stroke:#b9c4d4}
.node rect{stroke:#5b6b82;fill:#fff}
.task rect{fill:#e6effc;stroke:#3b6fb6}
.in rect,.out rect{fill:#fdf3da;stroke:#b98a1d}
.distributer rect{fill:#eceff3;stroke:#7a8594;stroke-dasharray:4 3}
.node text{fill:currentColor;text-anchor:middle;font-size:10px}
.node .name{font-size:11.5px;font-weight:600}
.node .more{opacity:.72}
.arrow{fill:none;stroke:#6b7a90;stroke-width:1.2}
.channel{stroke-dasharray:4 3}
.head{fill:#6b7a90}
.title{font-size:11px;fill:currentColor;opacity:.72}
@media (prefers-color-scheme:dark){
svg{background:#12161c;color:#dfe6f0}
.core{fill:#181e27;stroke:#3a4657}
.task rect{fill:#1d3354;stroke:#6fa3ea}
.in rect,.out rect{fill:#3d3214;stroke:#d3a63c}
.distributer rect{fill:#262d38;stroke:#8894a6}
.arrow{stroke:#8b9ab0}.head{fill:#8b9ab0}
}
)";

std::string tenths(double number) { return fixed(number, 1); }

std::string path_of(const DrawnArrow& arrow) {
  std::string path;
  for (std::size_t i = 0; i < arrow.curve.size(); ++i)
    path += (i == 0 ? "M" : i == 1 ? "C" : " ") + tenths(arrow.curve[i][0]) + "," + tenths(arrow.curve[i][1]);
  return path;
}

void draw_core(const Drawing& drawing, const std::string& title, Svg& svg) {
  svg.element("rect", {{"class", "core"},
                       {"x", tenths(drawing.core_x)},
                       {"y", tenths(drawing.core_y)},
                       {"width", tenths(drawing.core_width)},
                       {"height", tenths(drawing.core_height)},
                       {"rx", "10"}});
  svg.line_end();
  svg.element("text", {{"class", "title"}, {"x", tenths(drawing.core_x + 10)}, {"y", tenths(drawing.core_y + 16)}},
              title);
  svg.line_end();
}

// Its title has a line for each connection.
void draw_arrow(const DrawnArrow& arrow, Svg& svg) {
  svg.begin("path", {{"class", arrow.connections.empty() ? "arrow channel" : "arrow"},
                     {"marker-end", "url(#head)"},
                     {"d", path_of(arrow)}});
  svg.begin("title");
  std::istringstream lines(arrow.text);
  std::string line;
  for (bool first = true; std::getline(lines, line); first = false) {
    if (!first) svg.line_end();
    svg.words(line);
  }
  svg.end().end().line_end();
}

void draw_node(const DrawnNode& node, Svg& svg) {
  const double left = node.x - node.width / 2, top = node.y - node.height / 2;
  svg.begin("g", {{"class", "node " + std::string(word_of(node.kind))}});
  svg.element("rect", {{"x", tenths(left)},
                       {"y", tenths(top)},
                       {"width", tenths(node.width)},
                       {"height", tenths(node.height)},
                       {"rx", node.kind == DrawnNode::Kind::task ? "7" : "2"}});
  double y = top + 19;
  svg.element("text", {{"class", "name"}, {"x", tenths(node.x)}, {"y", tenths(y)}}, node.name);
  for (const std::string& line : node.lines)
    svg.element("text", {{"class", "more"}, {"x", tenths(node.x)}, {"y", tenths(y += 13)}}, line);
  svg.end().line_end();
}

}  // namespace

std::string to_svg(const Drawing& drawing, const std::string& title) {
  const std::string width = fixed(drawing.width, 0), height = fixed(drawing.height, 0);
  Svg svg;
  svg.begin("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                    {"viewBox", "0 0 " + width + " " + height},
                    {"width", width},
                    {"height", height},
                    {"role", "img"}});
  svg.line_end().element("title", {}, title).line_end().style(style);
  svg.begin("defs").begin("marker", {{"id", "head"},
                                     {"viewBox", "0 0 8 8"},
                                     {"refX", "7"},
                                     {"refY", "4"},
                                     {"markerWidth", "7"},
                                     {"markerHeight", "7"},
                                     {"orient", "auto"}});
  svg.element("path", {{"class", "head"}, {"d", "M0,0.5L8,4L0,7.5z"}}).end().end().line_end();
  draw_core(drawing, title, svg);
  for (const DrawnArrow& arrow : drawing.arrows) draw_arrow(arrow, svg);
  for (const DrawnNode& node : drawing.nodes) draw_node(node, svg);
  svg.end().line_end();
  return svg.text();
}

}  // namespace jarol::tools
