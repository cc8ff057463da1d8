#include "graph/analysis/system.h"

#include <algorithm>
#include <numeric>

#include "graph/model/stages.h"

namespace jarol::analysis {

System system_of(const Graph& graph) {
  System system;
  system.policy = policy_of(graph.platform);
  system.cores = graph.platform.cores;
  system.offsets_hold = graph.platform.phasing == Phasing::given;
  std::vector<std::int64_t> bytes(graph.tasks.size(), 0);
  for (const Connection& c : graph.connections)
    if (c.from.kind == End::Kind::task) bytes[c.from.index] += static_cast<std::int64_t>(c.type->size);
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Task& t = graph.tasks[i];
    // more than the longest deadline that there is need not be told apart
    const Wide handed_on = static_cast<Wide>(graph.platform.copy.count()) * bytes[i] + graph.platform.dispatch.count();
    const Duration overhead = t.wcet ? std::min(saturated(handed_on), longest_duration) : Duration{};
    system.models.push_back(
        {t.wcet.value_or(Duration{}) + overhead, t.period, t.deadline, t.offset, t.jitter, t.blocking, overhead});
    system.priority.push_back(t.priority);
    system.core.push_back(t.core);
  }
  system.rank.resize(graph.tasks.size());
  for (std::size_t i = 0; i < graph.order.size(); ++i) system.rank[graph.order[i]] = i;
  const std::vector<std::size_t> turns = dispatch_order(graph);
  system.turn.resize(graph.tasks.size());
  for (std::size_t i = 0; i < turns.size(); ++i) system.turn[turns[i]] = i;
  for (const Connection& c : graph.connections) {
    if (c.from.kind != End::Kind::task || c.to.kind != End::Kind::task) continue;
    const Task &producer = graph.tasks[c.from.index], &reader = graph.tasks[c.to.index];
    if (producer.let) continue;
    const std::int64_t gcd = std::gcd(producer.period.count(), reader.period.count());
    if ((producer.offset - reader.offset).count() % gcd == 0) system.follows.emplace_back(c.from.index, c.to.index);
  }
  return system;
}

std::optional<std::size_t> overfull_core(const System& system) {
  for (std::int64_t core = 0; system.policy.keeps_core && system.cores > 1 && core < system.cores; ++core) {
    TaskModels stated;
    for (std::size_t i = 0; i < system.models.size(); ++i)
      if (system.core[i] == core) stated.push_back(system.models[i]);
    if (compare_utilisation(stated, 1) == std::strong_ordering::greater) return static_cast<std::size_t>(core);
  }
  return std::nullopt;
}

}  // namespace jarol::analysis
