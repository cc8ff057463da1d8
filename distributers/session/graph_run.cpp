#include "distributers/session/graph_run.h"

#include <algorithm>
#include <utility>

namespace jarol {
namespace {

RunStart start_of(Loaded& loaded) { return {{}, std::move(loaded.channels)}; }

}  // namespace

GraphRun::GraphRun(Loaded loaded, const GraphRunOptions& options)
    : GraphRun(std::move(loaded), *loaded.graph, *loaded.graph, start_of(loaded), options) {}

GraphRun::GraphRun(const PlannedGraph& of, RunStart start, const GraphRunOptions& options)
    : GraphRun({}, of.graph(), of.plan(), std::move(start), options) {}

GraphRun::GraphRun(Loaded&& loaded, const Graph& graph, PlanOfRun plan, RunStart start, const GraphRunOptions& options)
    : loaded_(std::move(loaded)),
      graph_(graph),
      channels_(pointers_to(start.channels)),
      sinks_(graph, options.sinks, options.measured),
      executor_(std::move(plan), std::move(start.channels),
                {.digest = true,
                 .recorder = sinks_.recorder(),
                 .record_truth = !options.misses,
                 .measured = options.measured,
                 .workers = options.workers,
                 .clock = options.clock,
                 .threads = options.threads,
                 .log = options.log,
                 .misses = options.misses}) {
  for (const RunStart::Parameters& changed : start.parameters)
    executor_.start_with(changed.task, changed.values.data());
}

RunVerdict GraphRun::judge(Duration until, const RunEnd& end, const std::string& unseen) const {
  return judge_run(graph(), executor_.report(), channels_, sinks_, executor_.rest(), until, end, unseen);
}

std::vector<Verdict> GraphRun::measure(Duration until) const {
  const Report& report = executor_.report();
  return sinks_.measure(std::min(until, report.covered),
                        why_cut_short(report.simulated, until, end_of_mission(channels_)));
}

}  // namespace jarol
