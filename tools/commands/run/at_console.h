// Operators of a graph who steer at the pages of a console.
#pragma once

#include <vector>

#include "distributers/session/load.h"
#include "tools/commands/run/run_options.h"
#include "tools/console/desk.h"

namespace jarol::tools {

/// Those whose link is the console.
std::vector<console::DeskOperator> operators_at_console(const Loaded& loaded);

/// Throws InputError where there are any, and no console.
void require_console(const RunArguments& options, const Loaded& loaded);

}  // namespace jarol::tools
