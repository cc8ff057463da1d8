#include "runtime/run/run.h"

namespace jarol {
namespace {

// Where the vehicle may be brought to rest, what that depends on.
std::span<const expect::Signal> tapped_signals(const Graph& graph, bool may_rest) {
  if (!may_rest) return {};
  return graph.at_end->until.signals;
}

}  // namespace

Run::Run(PlanOfRun of, const Options& options)
    : shared_plan(std::move(of)),
      plan(*shared_plan),
      graph(plan.graph),
      may_rest(options.may_rest && graph.at_end),
      state(plan, tapped_signals(graph, may_rest)),
      report(graph.tasks.size()),
      publisher(options.digest, report.digest, options.recorder),
      log(graph, options.log),
      faults(state, report, publisher, log) {
  if (options.recorder != nullptr) options.recorder->expect(plan.outputs);
}

}  // namespace jarol
