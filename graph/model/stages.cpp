#include "graph/model/stages.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace jarol {
namespace {

bool in_same_group(const Task& a, const Task& b) { return a.period == b.period && a.offset == b.offset; }

bool coincide(const Task& a, const Task& b) {
  return (a.offset - b.offset).count() % std::gcd(a.period.count(), b.period.count()) == 0;
}

}  // namespace

Stages stages_of(const Graph& graph) {
  const std::size_t count = graph.tasks.size();
  // the tasks that each feeds at its release
  std::vector<std::vector<std::size_t>> readers(count);
  for (const Connection& c : graph.connections)
    if (c.from.kind == End::Kind::task && c.to.kind == End::Kind::task && !graph.tasks[c.from.index].let)
      readers[c.from.index].push_back(c.to.index);
  Stages stages{std::vector<std::uint32_t>(count, 0), std::vector<std::uint32_t>(count, 0)};
  for (const std::size_t i : graph.order)
    for (const std::size_t reader : readers[i]) {
      const Task &producer = graph.tasks[i], &task = graph.tasks[reader];
      if (!coincide(producer, task)) continue;
      const std::uint32_t after = stages.stage[i] + (in_same_group(producer, task) ? 0 : 1);
      stages.stage[reader] = std::max(stages.stage[reader], after);
    }
  for (const std::size_t i : graph.order)
    for (const std::size_t reader : readers[i])
      if (in_same_group(graph.tasks[i], graph.tasks[reader]) && stages.stage[reader] == stages.stage[i])
        stages.level[reader] = std::max(stages.level[reader], stages.level[i] + 1);
  return stages;
}

GroupDeadlines group_deadlines(const Graph& graph) {
  GroupDeadlines min;
  for (const Task& task : graph.tasks) {
    const auto [at, is_first] = min.emplace(std::pair(task.period, task.offset), task.deadline);
    if (!is_first) at->second = std::min(at->second, task.deadline);
  }
  return min;
}

std::vector<std::size_t> dispatch_order(const Graph& graph) {
  const Stages stages = stages_of(graph);
  const GroupDeadlines of_groups = group_deadlines(graph);
  std::vector<Duration> of_group;
  for (const Task& task : graph.tasks) of_group.push_back(of_groups.at({task.period, task.offset}));
  const auto key = [&](std::size_t i) {
    const Task& task = graph.tasks[i];
    return std::tuple(stages.stage[i], of_group[i], task.period, task.offset, stages.level[i], task.deadline);
  };
  std::vector<std::size_t> order = graph.order;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

}  // namespace jarol
