// What a run, or the replay of one, reports at its end.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "distributers/session/run_outcome.h"
#include "tools/report/run_end.h"
#include "tools/report/tracking.h"
#include "tools/report/verdicts.h"

namespace jarol::tools {

/// All but the first line.
std::string to_text(const RunOutcome& outcome);
nlohmann::ordered_json to_json(const RunOutcome& outcome);

/// Logical seconds per second.
double real_time_factor(const RunOutcome& outcome);

}  // namespace jarol::tools
