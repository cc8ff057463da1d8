#include "distributers/session/graph_run.h"

#include <utility>

namespace jarol {

GraphRun::GraphRun(Loaded loaded, const GraphRunOptions& options)
    : loaded_(std::move(loaded)),
      channels_(pointers_to(loaded_.channels)),
      sinks_(*loaded_.graph, options.sinks),
      executor_(*loaded_.graph, std::move(loaded_.channels),
                {.digest = true,
                 .recorder = sinks_.recorder(),
                 .record_truth = !options.misses,
                 .workers = options.workers,
                 .clock = options.clock,
                 .threads = options.threads,
                 .log = options.log,
                 .misses = options.misses}) {}

RunVerdict GraphRun::judge(Duration until, const RunEnd& end, const std::string& unseen) const {
  return judge_run(graph(), executor_.report(), channels_, sinks_, executor_.rest(), until, end, unseen);
}

}  // namespace jarol
