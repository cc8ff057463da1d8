#include "tools/commands/run/watch_run.h"

#include "distributers/session/recorded_truth.h"
#include "tools/commands/run/at_console.h"
#include "tools/console/console.h"

namespace jarol::tools {

std::unique_ptr<console::View> watch_run(const RunArguments& options, const Loaded& loaded, Duration until,
                                         Pace* pace) {
  return std::make_unique<console::Console>(
      console::Watched{{*loaded.graph, options.file, options.clock, until, types_of_truth(loaded),
                        console::find_flow(*loaded.graph, loaded.known->vehicles, loaded.files),
                        console::Given{options.file, options.overrides, options.seed}},
                       server_of(options.console),
                       pace,
                       operators_at_console(loaded)});
}

}  // namespace jarol::tools
