// The verdict on a run, in its report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "distributers/session/verdict.h"

namespace jarol::tools {

/// Good, negative, or unfinished, where there is nothing to judge by: the vehicle was lost from the start.
int exit_code_of(const RunVerdict& verdict);

/// A line for each condition.
std::string to_text(const RunVerdict& verdict);
nlohmann::ordered_json to_json(const RunVerdict& verdict);

/// A line for each reason why it is not good.
std::string failures_text(const RunVerdict& verdict);

}  // namespace jarol::tools
