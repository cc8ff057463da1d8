#include "tools/drawing/graph/svg.h"

#include <fmt/format.h>

#include <sstream>

#include "graph/text/escape.h"

namespace jarol::tools {
namespace {

constexpr const char* style = R"(<style>
svg{font-family:sans-serif;background:#fff;color:#1c2430}
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
</style>
)";

// A line for each connection.
std::string title_of(const DrawnArrow& arrow) {
  std::istringstream lines(arrow.text);
  std::string text;
  for (std::string line; std::getline(lines, line);) text += (text.empty() ? "" : "\n") + xml_text(line);
  return text;
}

std::string path_of(const DrawnArrow& arrow) {
  std::string path;
  for (std::size_t i = 0; i < arrow.curve.size(); ++i)
    path += fmt::format("{}{:.1f},{:.1f}", i == 0 ? "M" : i == 1 ? "C" : " ", arrow.curve[i][0], arrow.curve[i][1]);
  return path;
}

std::string node_text(const DrawnNode& node) {
  const double left = node.x - node.width / 2, top = node.y - node.height / 2;
  std::string text =
      fmt::format("<g class=\"node {}\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"{}\"/>",
                  word_of(node.kind), left, top, node.width, node.height, node.kind == DrawnNode::Kind::task ? 7 : 2);
  double y = top + 19;
  text += fmt::format("<text class=\"name\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", node.x, y, xml_text(node.name));
  for (const std::string& line : node.lines)
    text += fmt::format("<text class=\"more\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", node.x, y += 13, xml_text(line));
  return text + "</g>\n";
}

}  // namespace

std::string to_svg(const Drawing& drawing, const std::string& title) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "role=\"img\">\n<title>{2}</title>\n",
      drawing.width, drawing.height, xml_text(title));
  text += style;
  text +=
      "<defs><marker id=\"head\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" "
      "orient=\"auto\"><path class=\"head\" d=\"M0,0.5L8,4L0,7.5z\"/></marker></defs>\n";
  text += fmt::format(
      "<rect class=\"core\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"10\"/>\n"
      "<text class=\"title\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
      drawing.core_x, drawing.core_y, drawing.core_width, drawing.core_height, drawing.core_x + 10, drawing.core_y + 16,
      xml_text(title));
  for (const DrawnArrow& arrow : drawing.arrows)
    text += fmt::format("<path class=\"arrow{}\" marker-end=\"url(#head)\" d=\"{}\"><title>{}</title></path>\n",
                        arrow.connections.empty() ? " channel" : "", path_of(arrow), title_of(arrow));
  for (const DrawnNode& node : drawing.nodes) text += node_text(node);
  return text + "</svg>\n";
}

}  // namespace jarol::tools
