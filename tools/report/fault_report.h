// The faults of a run, as a report shows them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/execute/executor.h"

namespace jarol::tools {

/// A line for each task and cause.
std::string fault_report(const Report& report);
nlohmann::ordered_json fault_summary_to_json(const Report& report);
/// Those that were kept.
nlohmann::ordered_json faults_to_json(const Report& report);

}  // namespace jarol::tools
