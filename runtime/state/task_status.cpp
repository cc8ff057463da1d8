#include "runtime/state/task_status.h"

#include <cstring>

namespace jarol {
namespace {

// Runs a task that has a heap: what it allocates meanwhile is scratch.
Outcome run_with_heap(TaskStatus& status, const TaskMemory& memory, const Tick& tick) {
  for (const DeepInput& input : status.deep_inputs) {
    if (!input.lost) continue;
    static_cast<FaultText&>(status) = input;
    return Outcome::heap_exhausted;
  }
  const MemoryScope scope(status.heap->scratch());
  const Outcome outcome = status.run(memory, tick);
  status.heap->release_scratch();
  return outcome;
}

}  // namespace

Outcome run_with_care(const TaskMemory& memory, const Tick& tick) {
  auto& status = static_cast<TaskStatus&>(*memory.fault);
  if (status.skip_next) {
    status.skip_next = false;
    return Outcome::left_out;
  }
  if (status.recoverable) status.keep(memory.state);
  if (status.begins_anew) {
    const Outcome outcome = contain([&] { status.begin_anew(memory.state); }, [&]() -> FaultText& { return status; });
    if (outcome != Outcome::good) return outcome;
  }
  return status.heap != nullptr ? run_with_heap(status, memory, tick) : status.run(memory, tick);
}

void TaskStatus::keep(const void* state) {
  std::memcpy(kept, state, size);
  if (heap != nullptr) heap->keep(kept + size);
}

void TaskStatus::restore(void* state) {
  std::memcpy(state, kept, size);
  if (heap != nullptr) heap->restore(kept + size);
}

void TaskStatus::begin_anew(void* state) {
  if (first_state == nullptr) {
    state_type->construct(state);
  } else {
    state_type->assign(state, first_state);
  }
  begins_anew = false;
}

}  // namespace jarol
