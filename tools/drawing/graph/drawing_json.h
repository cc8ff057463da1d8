// A drawing for pages.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tools/drawing/graph/layout.h"

namespace jarol::tools {

nlohmann::ordered_json to_json(const Drawing& drawing);

}  // namespace jarol::tools
