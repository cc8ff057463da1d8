// How a run ended, in its report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/execute/attend.h"

namespace jarol::tools {

/// Ctrl-Z has ended the run, all is safe: halts the process as Ctrl-Z does. Nothing if it was something else.
void halt_if_asked(const RunEnd& end);

/// What the first line of the report says of it: " (interrupted)", or nothing.
std::string suffix_of(const RunEnd& end);
/// Lines for stderr: what was lost, and what hangs.
std::string errors_of(const RunEnd& end, Duration now);
nlohmann::ordered_json to_json(const RunEnd& end);
/// Without what can't be written.
int exit_code_of(const RunEnd& end);

}  // namespace jarol::tools
