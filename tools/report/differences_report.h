// Where two runs part, as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/record/differences.h"

namespace jarol::tools {

/// The first difference, then the signals; nothing where there is none.
std::string text_of(const Differences& differences);

nlohmann::ordered_json json_of(const Differences& differences);

}  // namespace jarol::tools
