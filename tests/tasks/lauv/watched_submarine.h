// The supervisor of a calm submarine of which something is changed, step by step.
#pragma once

#include <cstdint>
#include <functional>

#include "tests/tasks/calm_submarine.h"
#include "tests/tasks/lauv/every_50_ms.h"

namespace jarol::tests {

using Change = std::function<void(tasks::LauvSupervisor::In&)>;

inline const Change unchanged = [](tasks::LauvSupervisor::In&) {};

struct WatchedSubmarine {
  tasks::LauvSupervisor::State state{};
  tasks::LauvSupervisor::Out out{};
  std::int64_t k = 0;

  /// So many steps of 50 ms.
  tasks::Alarm run(int steps, const Change& change) {
    for (int i = 0; i < steps; ++i) {
      tasks::LauvSupervisor::In in = calm_submarine(++k);
      change(in);
      tasks::LauvSupervisor::run({}, every_50_ms, in, state, out);
    }
    return out.condition.alarm;
  }
  /// As many until an alarm; 0: none within 100 s.
  int steps_to_alarm(const Change& change) {
    for (int step = 1; step <= 2000; ++step)
      if (run(1, change) != tasks::Alarm::none) return step;
    return 0;
  }
};

}  // namespace jarol::tests
