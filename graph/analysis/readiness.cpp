#include "graph/analysis/readiness.h"

#include <algorithm>

namespace jarol::analysis {
namespace {

using Producers = std::vector<std::vector<std::size_t>>;  // per task

Producers producers_of(const CoreTasks& tasks) {
  Producers producers(tasks.models.size());
  for (const auto& [producer, reader] : tasks.follows) producers[reader].push_back(producer);
  return producers;
}

// All tasks, each behind those that it follows: they stand neither in order of urgency nor of data flow.
std::vector<std::size_t> producers_first(const CoreTasks& tasks) {
  std::vector<std::vector<std::size_t>> readers(tasks.models.size());
  std::vector<std::size_t> missing(tasks.models.size(), 0), order;
  for (const auto& [producer, reader] : tasks.follows) {
    readers[producer].push_back(reader);
    ++missing[reader];
  }
  for (std::size_t i = 0; i < missing.size(); ++i)
    if (missing[i] == 0) order.push_back(i);
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const std::size_t reader : readers[order[k]])
      if (--missing[reader] == 0) order.push_back(reader);
  return order;
}

// Does the producer arrive with every activation of the reader?
bool is_always_there(const TaskModel& producer, const TaskModel& reader) {
  return producer.offset <= reader.offset && reader.period % producer.period == Duration{} &&
         (reader.offset - producer.offset) % producer.period == Duration{};
}

}  // namespace

TaskModels inheriting_loads(const CoreTasks& tasks) {
  TaskModels models = tasks.models;
  const Producers producers = producers_of(tasks);
  for (const std::size_t reader : producers_first(tasks))
    for (const std::size_t p : producers[reader]) {
      models[reader].jitter = std::max(models[reader].jitter, models[p].jitter);
      models[reader].blocking = std::max(models[reader].blocking, models[p].blocking);
    }
  return models;
}

ReadinessAt::ReadinessAt(const CoreTasks& tasks)
    : tasks_(tasks),
      producers_(producers_of(tasks)),
      always_(tasks.models.size()),
      known_(tasks.models.size(), {Duration(-1), {}}) {
  for (const std::size_t task : producers_first(tasks)) {
    Readiness ready{tasks.models[task].jitter, tasks.models[task].blocking};
    const bool all = std::all_of(producers_[task].begin(), producers_[task].end(), [&](std::size_t p) {
      if (!always_[p] || !is_always_there(tasks.models[p], tasks.models[task])) return false;
      ready = {std::max(ready.jitter, always_[p]->jitter), std::max(ready.blocking, always_[p]->blocking)};
      return true;
    });
    if (all) always_[task] = ready;
  }
}

Readiness ReadinessAt::operator()(std::size_t task, Duration instant) {
  if (always_[task]) return *always_[task];
  if (known_[task].first == instant) return known_[task].second;
  Readiness ready{tasks_.models[task].jitter, tasks_.models[task].blocking};
  for (const std::size_t p : producers_[task]) {
    const TaskModel& m = tasks_.models[p];
    if (instant < m.offset || (instant - m.offset) % m.period != Duration{}) continue;
    const Readiness before = (*this)(p, instant);
    ready = {std::max(ready.jitter, before.jitter), std::max(ready.blocking, before.blocking)};
  }
  known_[task] = {instant, ready};
  return ready;
}

}  // namespace jarol::analysis
