#include "graph/analysis/readiness.h"

#include <algorithm>

namespace jarol::analysis {
TaskModels inheriting_loads(const CoreTasks& tasks) {
  TaskModels models = tasks.models;
  // chains of followers are no longer than there are tasks
  bool changed = true;
  for (std::size_t round = 0; changed && round <= models.size(); ++round) {
    changed = false;
    for (const auto& [producer, reader] : tasks.follows) {
      const TaskModel& p = models[producer];
      TaskModel& r = models[reader];
      if (r.jitter >= p.jitter && r.blocking >= p.blocking) continue;
      r.jitter = std::max(r.jitter, p.jitter);
      r.blocking = std::max(r.blocking, p.blocking);
      changed = true;
    }
  }
  return models;
}

ReadinessAt::ReadinessAt(const CoreTasks& tasks)
    : tasks_(tasks), producers_(tasks.models.size()), known_(tasks.models.size(), {-1, {}}) {
  for (const auto& [producer, reader] : tasks.follows) producers_[reader].push_back(producer);
}

Readiness ReadinessAt::operator()(std::size_t task, std::int64_t instant) {
  if (known_[task].first == instant) return known_[task].second;
  Readiness ready{tasks_.models[task].jitter, tasks_.models[task].blocking};
  for (const std::size_t p : producers_[task]) {
    const TaskModel& m = tasks_.models[p];
    if (instant < m.offset || (instant - m.offset) % m.period != 0) continue;
    const Readiness before = (*this)(p, instant);
    ready = {std::max(ready.jitter, before.jitter), std::max(ready.blocking, before.blocking)};
  }
  known_[task] = {instant, ready};
  return ready;
}

}  // namespace jarol::analysis
