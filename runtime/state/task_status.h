// What only faults need to know of a task, away from what every activation reads.
#pragma once

#include <cstddef>
#include <cstdint>

#include "graph/values/heap.h"
#include "runtime/state/actions.h"

namespace jarol {

struct TaskStatus : FaultText {
  std::uint32_t task = 0;
  std::int64_t activation = 0;  // the faulty one
  bool skip_next = false;       // the next activation is left out
  bool begins_anew = false;     // the next activation begins with the state that the task began with
  bool recoverable = false;     // state and outputs are kept before each activation
  Thunk run = nullptr;
  PrivateHeap* heap = nullptr;
  Range<DeepInput> deep_inputs;
  std::byte* kept = nullptr;          // as large as state, outputs and heap
  std::size_t size = 0;               // of state and outputs, which lie next to each other
  const Type* state_type = nullptr;   // of a task that is restarted
  const void* first_state = nullptr;  // the same, if that is deep: what it began with

  void keep(const void* state);
  void restore(void* state);
  /// Throws HeapExhausted where there is no room for it; then the state has to be put back.
  void begin_anew(void* state);
};

/// Runs a task that has a heap or may have to be undone: what to undo is kept until the outcome has been seen.
Outcome run_with_care(const TaskMemory& memory, const Tick& tick);

}  // namespace jarol
