// Tasks that can write to nothing but their own inputs, state, outputs and heap, and their stack.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/machine/page_guard.h"
#include "runtime/state/run_state.h"

namespace jarol {

class TaskGuard {
 public:
  /// There is one at a time, made by the main thread. Throws Unfinished where there is none to be had.
  TaskGuard();
  ~TaskGuard();
  TaskGuard(const TaskGuard&) = delete;
  TaskGuard& operator=(const TaskGuard&) = delete;

  /// From now on the tasks of that state, of a plan with Spacing::pages, run under it, by one thread.
  void take(RunState& state);

  struct Owner {
    std::uint32_t task = 0;
    bool has_parameters_there = false;
  };
  /// The task to whose memory an address belongs, if any; for handlers of signals.
  static std::optional<Owner> find_owner(const void* address);

 private:
  static Outcome run_guarded(const TaskMemory& memory, const Tick& tick);

  PageGuard pages_;
  RunState* state_ = nullptr;
  std::vector<Thunk> runs_;  // per task
};

}  // namespace jarol
