// What the report of a check says in the same words as text and as JSON.
#pragma once

#include <string>

#include "tools/commands/check/check_report.h"

namespace jarol::tools {

/// Who runs when, and what that costs.
std::string assumption(const Graph& graph);

/// What a verdict rests on: "proof", "safe", "by a run" or "none".
std::string word_of(analysis::Evidence evidence);

}  // namespace jarol::tools
