#include "graph/analysis/witness.h"

#include <utility>

namespace jarol::analysis {

void add_witness(const CoreTasks& tasks, const Policy& policy, std::int64_t until, CoreResult& result) {
  constexpr std::uint64_t max_activations = 1'000'000;
  const Order order = policy.urgency == Urgency::deadline ? Order::by_deadline : Order::by_priority;
  Simulation run = simulate(tasks.models, order, policy.interrupts, until, max_activations);
  result.late = run.late;
  if (run.late) result.slices = std::move(run.slices);
}

}  // namespace jarol::analysis
