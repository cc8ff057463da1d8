// Where two runs part, as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/record/differences.h"

namespace jarol::tools {

/// The first difference, then so many signals; nothing where there is none.
std::string text_of(const Differences& differences, std::size_t max = 20);

nlohmann::ordered_json json_of(const Differences& differences);

}  // namespace jarol::tools
