#include "distributers/session/graph_run.h"

#include <algorithm>
#include <utility>

namespace jarol {
namespace {

// On the real clock people see at once what little there is; on the virtual one whoever paces the run hands it on.
Duration hand_on_period_of(const GraphRunOptions& options) {
  if (options.watched && options.clock != nullptr) return std::chrono::milliseconds(20);
  return std::chrono::seconds(1);
}

RunStart start_of(Loaded& loaded) { return {{}, std::move(loaded.systems)}; }

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

GraphRun::GraphRun(Loaded loaded, const GraphRunOptions& options)
    : GraphRun(std::move(loaded), *loaded.graph,
               PlanOfRun(*loaded.graph, options.guard == nullptr ? Spacing::lines : Spacing::pages), start_of(loaded),
               options) {}

GraphRun::GraphRun(const PlannedGraph& of, RunStart start, const GraphRunOptions& options)
    : GraphRun({}, of.graph(), of.plan(), std::move(start), options) {}

GraphRun::GraphRun(Loaded&& loaded, const Graph& graph, PlanOfRun plan, RunStart start, const GraphRunOptions& options)
    : OwnedGraph(std::move(loaded)),
      JoinedGraph(graph, pointers_to(start.systems), options.sinks, options.measured, hand_on_period_of(options)),
      executor_(std::move(plan), std::move(start.systems),
                {.digest = true,
                 .recorder = sinks().recorder(),
                 .record_truth = true,
                 .record_all_truth = options.truth,
                 .measured = options.measured,
                 .workers = options.workers,
                 .clock = options.clock,
                 .threads = options.threads,
                 .log = options.log,
                 .misses = options.misses,
                 .schedule = options.schedule,
                 .guard = options.guard}),
      times_(options.times) {
  for (const RunStart::Parameters& changed : start.parameters)
    executor_.start_with(changed.task, changed.values.data());
}

RunOrigin origin_of(const Loaded& loaded, const Overrides& overrides, std::uint64_t seed,
                    std::vector<std::string> fed) {
  RunOrigin origin{{}, overrides.profile, overrides.set, seed, std::move(fed), find_program()};
  for (const auto& file : loaded.files) origin.files.push_back(file_of(*file));
  return origin;
}

Checkpoint GraphRun::checkpoint() {
  sinks().catch_up();
  if (const std::string failure = sinks().failure_of_conditions(); !failure.empty())
    throw CheckpointError("the run can't be saved, as what is expected of it is no longer looked at: " + failure);
  if (!sinks().lost().empty())
    throw CheckpointError("the run can't be saved, as not all that it published could be looked at: " + sinks().lost());
  Checkpoint made(origin_, executor_.now());
  made.save("run", executor_);
  made.save("conditions", sinks());
  if (!times_.empty()) made.save("execution", times_);
  return made;
}

void GraphRun::require_same_origin(const Checkpoint& checkpoint) const {
  if (const std::string wrong = find_difference(checkpoint.origin(), *origin_); !wrong.empty())
    throw CheckpointError(wrong);
}

void GraphRun::restore(const Checkpoint& checkpoint) {
  sinks().catch_up();
  std::string times;
  checkpoint.restore("execution", times);
  if (times != times_)
    throw CheckpointError(times.empty() ? "is of a run without --execution"
                                        : "is of a run with other execution times: --execution " + first_line(times));
  if (!checkpoint.restore("run", executor_) || !checkpoint.restore("conditions", sinks()))
    throw CheckpointError("is damaged: a part of it is missing");
}

std::vector<Verdict> GraphRun::measure(Duration until) const {
  const Report& report = executor_.report();
  return sinks().measure(std::min(until, report.covered), why_cut_short(report.simulated, until, {}));
}

}  // namespace jarol
