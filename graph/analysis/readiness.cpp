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
      const Load &p = loads[producer];
      Load& r = loads[reader];
      if (r.jitter >= p.jitter && r.blocking >= p.blocking) continue;
      r.jitter = std::max(r.jitter, p.jitter);
      r.blocking = std::max(r.blocking, p.blocking);
      changed = true;
    }
  }
  return loads;
}

JitterAt::JitterAt(const CoreTasks& tasks)
    : tasks_(tasks), producers_(tasks.loads.size()), known_(tasks.loads.size(), {-1, 0}) {
  for (const auto& [producer, reader] : tasks.follows) producers_[reader].push_back(producer);
}

std::int64_t JitterAt::operator()(std::size_t task, std::int64_t instant) {
  if (known_[task].first == instant) return known_[task].second;
  std::int64_t jitter = tasks_.loads[task].jitter;
  for (const std::size_t p : producers_[task]) {
    const Load& l = tasks_.loads[p];
    if (instant >= l.offset && (instant - l.offset) % l.period == 0) jitter = std::max(jitter, (*this)(p, instant));
  }
  known_[task] = {instant, jitter};
  return jitter;
}

}  // namespace jarol::analysis
