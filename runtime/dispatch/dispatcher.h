// Who runs the tasks of a run. It is asked at each instant, not for each task.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/machine/futex.h"
#include "runtime/machine/running_task.h"
#include "runtime/run/ending.h"
#include "runtime/run/now.h"

namespace jarol {

class Dispatcher {
 public:
  virtual ~Dispatcher() = default;

  /// Step 1 of an instant: publishes the outputs of LET tasks that end now.
  virtual void end_lets(const Now& now) = 0;
  /// Step 5: has the tasks run that are released now; publishes outputs of data-flow tasks when they are known.
  virtual void release(const Now& now) = 0;

  /// Tasks run on the thread that calls: while one does, nothing else happens.
  virtual bool runs_on_caller() const { return true; }
  /// What threads beside the caller's run; a null while one begins.
  virtual std::span<const std::atomic<const RunningTask*>> others() const { return {}; }

  // where tasks may still run when the instant of their release is over

  /// The one that was released first of those that have not ended and wait for no other. Any thread may ask.
  virtual std::optional<HangingTask> first_under_way() const { return std::nullopt; }

  /// Before an instant: publishes what has ended since.
  virtual void settle(Duration) {}
  /// At the beginning of an instant: all that was due before this one is known.
  virtual Duration settled(Duration instant) const { return instant; }
  /// Waits for what still runs; what runs after that nevertheless.
  virtual std::vector<HangingTask> drain(std::optional<Futex::Time>) { return {}; }
  /// What this machine does not permit the threads that run tasks; a plain sentence each.
  virtual std::vector<std::string> refusals() const { return {}; }
};

}  // namespace jarol
