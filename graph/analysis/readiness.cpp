#include "graph/analysis/readiness.h"

#include <algorithm>

namespace jarol::analysis {
Loads inheriting_loads(const CoreTasks& tasks) {
  Loads loads = tasks.loads;
  // chains of followers are no longer than there are tasks
  bool changed = true;
  for (std::size_t round = 0; changed && round <= loads.size(); ++round) {
    changed = false;
    for (const auto& [producer, reader] : tasks.follows) {
      const Load& p = loads[producer];
      Load& r = loads[reader];
      if (r.jitter >= p.jitter && r.blocking >= p.blocking) continue;
      r.jitter = std::max(r.jitter, p.jitter);
      r.blocking = std::max(r.blocking, p.blocking);
      changed = true;
    }
  }
  return loads;
}

ReadinessAt::ReadinessAt(const CoreTasks& tasks)
    : tasks_(tasks), producers_(tasks.loads.size()), known_(tasks.loads.size(), {-1, {}}) {
  for (const auto& [producer, reader] : tasks.follows) producers_[reader].push_back(producer);
}

Readiness ReadinessAt::operator()(std::size_t task, std::int64_t instant) {
  if (known_[task].first == instant) return known_[task].second;
  Readiness ready{tasks_.loads[task].jitter, tasks_.loads[task].blocking};
  for (const std::size_t p : producers_[task]) {
    const Load& l = tasks_.loads[p];
    if (instant < l.offset || (instant - l.offset) % l.period != 0) continue;
    const Readiness before = (*this)(p, instant);
    ready = {std::max(ready.jitter, before.jitter), std::max(ready.blocking, before.blocking)};
  }
  known_[task] = {instant, ready};
  return ready;
}

}  // namespace jarol::analysis
