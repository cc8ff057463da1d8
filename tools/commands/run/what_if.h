// What would have been: how it is asked for, and what is reported of it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "distributers/session/what_if.h"

namespace jarol::tools {

/// Of "at=30s set=tasks.depth.parameters.kp=0.2", with any number of `set`; a few of them. Throws
/// InputError.
std::vector<WhatIf> parse_what_ifs(const std::vector<std::string>& words);

/// The run and what became of each what-if, side by side; nothing if there is none.
std::string to_text(const RunColumn& run, const std::vector<WhatIfOutcome>& what_ifs);
nlohmann::ordered_json to_json(const std::vector<WhatIfOutcome>& what_ifs);

}  // namespace jarol::tools
