// The page that shows a run, made from the run's options.
#pragma once

#include <memory>
#include <vector>

#include "distributers/session/load.h"
#include "distributers/session/pace.h"
#include "tools/commands/run/run_options.h"
#include "tools/console/view.h"

namespace jarol::tools {

/// All that is named outlives the page. `pace`: null on the real clock.
std::unique_ptr<console::View> watch_run(const RunArguments& options, const Loaded& loaded, Duration until, Pace* pace);

}  // namespace jarol::tools
