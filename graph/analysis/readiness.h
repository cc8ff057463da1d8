// When a task is ready that follows others: with the last of them.
#pragma once

#include "graph/analysis/one_core.h"

namespace jarol::analysis {

/// Who reads waits for the jitter and the blocking of whom it follows, and runs after it, since it is less urgent: so
/// the reader is as a task without precedence that has the longest jitter and blocking of all that it follows (the
/// release times of Chetto, Silly, Bouchentouf 1990).
TaskModels inheriting_loads(const CoreTasks& tasks);

/// How late an activation can be ready, and how long held up, with those that arrive with it and that it follows.
struct Readiness {
  Duration jitter{}, blocking{};
};

/// Of the activation of a task that arrives at an instant.
class ReadinessAt {
 public:
  explicit ReadinessAt(const CoreTasks& tasks);
  Readiness operator()(std::size_t task, Duration instant);

 private:
  const CoreTasks& tasks_;
  std::vector<std::vector<std::size_t>> producers_;
  std::vector<std::optional<Readiness>> always_;       // per task: the same at each of its instants
  std::vector<std::pair<Duration, Readiness>> known_;  // per task: the instant it was last asked for, and what
};

}  // namespace jarol::analysis
