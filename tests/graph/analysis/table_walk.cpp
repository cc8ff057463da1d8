#include "tests/graph/analysis/table_walk.h"

#include <algorithm>
#include <numeric>

#include "graph/model/stages.h"

namespace jarol::truth {

TableWalk walk_table(const Graph& graph, const std::vector<std::size_t>& core) {
  const std::size_t n = graph.tasks.size();
  const std::vector<std::size_t> turns = dispatch_order(graph);
  std::vector<std::vector<std::size_t>> producers(n);
  std::int64_t hyperperiod = 1;
  for (const jarol::Task& t : graph.tasks) hyperperiod = std::lcm(hyperperiod, t.period.count());
  for (const Connection& c : graph.connections)
    if (c.from.kind == End::Kind::task && c.to.kind == End::Kind::task && !graph.tasks[c.from.index].let)
      producers[c.to.index].push_back(c.from.index);
  TableWalk walk;
  walk.longest.resize(n, 0);
  std::vector<std::int64_t> free(1 + *std::max_element(core.begin(), core.end()), 0), arrived(n, -1), ended(n, 0);
  // offsets are below periods: each hyperperiod, the first too, has the same arrivals
  std::vector<std::int64_t> before;
  for (std::int64_t begin = 0;; begin += hyperperiod) {
    std::vector<std::int64_t> backlog;
    for (const std::int64_t end : free) backlog.push_back(std::max<std::int64_t>(0, end - begin));
    if (backlog == before) return walk;
    before = backlog;
    ++walk.hyperperiods;
    for (std::int64_t now = begin; now < begin + hyperperiod; ++now)
      for (const std::size_t i : turns) {
        const jarol::Task& t = graph.tasks[i];
        if (now < t.offset.count() || (now - t.offset.count()) % t.period.count() != 0) continue;
        std::int64_t start = std::max(now + t.jitter.count(), free[core[i]]);
        for (const std::size_t p : producers[i])
          if (arrived[p] == now) start = std::max(start, ended[p]);
        arrived[i] = now;
        free[core[i]] = ended[i] = start + t.wcet->count() + t.blocking.count();
        walk.longest[i] = std::max(walk.longest[i], ended[i] - now);
        if (ended[i] <= now + t.deadline.count()) continue;
        walk.late = t.name + " " + std::to_string(now / t.period.count()) + " ends at " + std::to_string(ended[i]) +
                    "ns, due at " + std::to_string(now + t.deadline.count()) + "ns";
        return walk;
      }
  }
}

}  // namespace jarol::truth
