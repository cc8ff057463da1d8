#include "tools/drawing/graph/drawing_json.h"

#include <nlohmann/json.hpp>

namespace jarol::tools {

nlohmann::ordered_json to_json(const Drawing& drawing) {
  using Json = nlohmann::ordered_json;
  auto nodes = Json::array(), arrows = Json::array();
  for (const DrawnNode& n : drawing.nodes)
    nodes.push_back({{"kind", word_of(n.kind)},
                     {"name", n.name},
                     {"lines", n.lines},
                     {"x", n.x},
                     {"y", n.y},
                     {"width", n.width},
                     {"height", n.height}});
  for (const DrawnArrow& a : drawing.arrows)
    arrows.push_back(
        {{"from", a.from}, {"to", a.to}, {"connections", a.connections}, {"text", a.text}, {"curve", a.curve}});
  return {{"width", drawing.width},
          {"height", drawing.height},
          {"core", {drawing.core_x, drawing.core_y, drawing.core_width, drawing.core_height}},
          {"nodes", std::move(nodes)},
          {"arrows", std::move(arrows)}};
}

}  // namespace jarol::tools
