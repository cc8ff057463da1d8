#include "graph/model/deadlines.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>

namespace jarol {
namespace {

// Data-flow edges: from tasks without a LET to the tasks they feed.
std::vector<std::vector<std::size_t>> successors_of(const Graph& graph) {
  std::vector<std::vector<std::size_t>> successors(graph.tasks.size());
  for (const Connection& c : graph.connections) {
    if (c.from.kind != End::Kind::task || c.to.kind != End::Kind::task) continue;
    if (!graph.tasks[c.from.index].let) successors[c.from.index].push_back(c.to.index);
  }
  return successors;
}

// One cycle among the tasks that could not be ordered, beginning with the first of them.
std::vector<std::size_t> find_cycle(const std::vector<std::vector<std::size_t>>& successors,
                                    const std::vector<bool>& ordered) {
  // every unordered task that has an unordered predecessor chain leads back: walk predecessors until one repeats
  std::vector<std::size_t> predecessor(successors.size(), successors.size());
  for (std::size_t i = successors.size(); i-- > 0;)
    if (!ordered[i])
      for (const std::size_t next : successors[i])
        if (!ordered[next]) predecessor[next] = i;
  std::size_t at = 0;
  while (ordered[at] || predecessor[at] == successors.size()) ++at;
  std::vector<bool> seen(successors.size(), false);
  while (!seen[at]) {
    seen[at] = true;
    at = predecessor[at];
  }
  std::vector<std::size_t> cycle;
  const std::size_t start = at;
  do {
    cycle.push_back(at);
    at = predecessor[at];
  } while (at != start);
  std::reverse(cycle.begin(), cycle.end());
  std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
  return cycle;
}

void report_cycle(const Graph& graph, const std::vector<std::size_t>& cycle, Problems& problems) {
  std::string path;
  for (const std::size_t i : cycle) path += graph.tasks[i].name + " -> ";
  const Task& first = graph.tasks[cycle.front()];
  problems.add(first.where,
               "tasks " + path + first.name + " feed each other in a cycle without a LET; give one of them a 'let'");
}

}  // namespace

Duration min_distance(Duration period, Duration offset, Duration other_period, Duration other_offset) {
  const std::int64_t gcd = std::gcd(period.count(), other_period.count());
  std::int64_t distance = (other_offset.count() - offset.count()) % gcd;
  if (distance <= 0) distance += gcd;
  return Duration(distance);
}

std::vector<std::size_t> data_flow_order(const Graph& graph, Problems& problems) {
  const auto successors = successors_of(graph);
  std::vector<std::size_t> waits_for(graph.tasks.size(), 0);
  for (const auto& list : successors)
    for (const std::size_t i : list) ++waits_for[i];
  // tasks are in order of name, so the least index is the least name
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
  for (std::size_t i = 0; i < waits_for.size(); ++i)
    if (waits_for[i] == 0) ready.push(i);
  std::vector<std::size_t> order;
  std::vector<bool> ordered(graph.tasks.size(), false);
  while (!ready.empty()) {
    const std::size_t i = ready.top();
    ready.pop();
    order.push_back(i);
    ordered[i] = true;
    for (const std::size_t next : successors[i])
      if (--waits_for[next] == 0) ready.push(next);
  }
  if (order.size() < graph.tasks.size()) report_cycle(graph, find_cycle(successors, ordered), problems);
  return order;
}

void set_deadlines(Graph& graph, const std::vector<Maybe<Duration>>& declared, Problems& problems) {
  std::vector<std::vector<const Connection*>> outgoing(graph.tasks.size());
  for (const Connection& c : graph.connections)
    if (c.from.kind == End::Kind::task) outgoing[c.from.index].push_back(&c);
  // readers first: a deadline depends on those of the tasks that latch at the same release
  for (auto at = graph.order.rbegin(); at != graph.order.rend(); ++at) {
    Task& task = graph.tasks[*at];
    Duration deadline = task.let.value_or(task.period);
    if (!task.let) {
      for (const Connection* c : outgoing[*at]) {
        const bool is_task = c->to.kind == End::Kind::task;
        const Duration period = is_task ? graph.tasks[c->to.index].period : graph.communicators[c->to.index].period;
        const Duration offset = is_task ? graph.tasks[c->to.index].offset : graph.communicators[c->to.index].offset;
        const Duration later = min_distance(task.period, task.offset, period, offset);
        deadline = std::min(deadline, later);
        const bool coincide = later.count() == std::gcd(task.period.count(), period.count());
        if (is_task && coincide) deadline = std::min(deadline, graph.tasks[c->to.index].deadline);
      }
    }
    task.deadline = deadline;
    if (!declared[*at]) continue;
    if (declared[*at]->value <= deadline) {
      task.deadline = declared[*at]->value;
    } else {
      problems.add(declared[*at]->where,
                   "task '" + task.name + "' has deadline " + duration_text(declared[*at]->value) + " later than " +
                       duration_text(deadline) + ", which follows from " +
                       (task.let ? "its LET" : "what reads its outputs") + "; lower it or leave it out");
    }
  }
}

}  // namespace jarol
