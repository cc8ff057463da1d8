#include "graph/analysis/witness.h"

#include <utility>

#include "graph/analysis/simulate_global.h"

namespace jarol::analysis {
namespace {

// Readers that would go before what they follow wait for it.
GlobalSimulation run_with_readers(const CoreTasks& tasks, Order order, bool preemptive) {
  constexpr std::uint64_t max_activations = 2'000;  // each looks at all that have not ended
  std::vector<std::pair<std::size_t, std::size_t>> follows = tasks.follows;
  follows.insert(follows.end(), tasks.upward.begin(), tasks.upward.end());
  TaskModels models = tasks.models;
  for (TaskModel& m : models) m.jitter = {};
  const std::vector<std::size_t> core(models.size(), 0);
  const RunRules rules{
      .follows = follows, .core = core, .by_order = order == Order::by_priority, .preemptive = preemptive};
  return simulate_global(models, 1, max_activations, rules);
}

template <class T>
void take_late(T run, CoreResult& result) {
  result.late = run.late;
  if (!run.late) return;
  result.slices = std::move(run.slices);
  result.slices_from = run.slices_from;
}

}  // namespace

void add_witness(const CoreTasks& tasks, Order order, bool preemptive, Duration until, CoreResult& result) {
  constexpr std::uint64_t max_activations = 1'000'000;
  if (!tasks.upward.empty()) return take_late(run_with_readers(tasks, order, preemptive), result);
  take_late(simulate(tasks.models, order, preemptive, until, max_activations), result);
}

}  // namespace jarol::analysis
