// The executor at the end of a run.
#include <thread>

#include "runtime/execute/executor.h"

namespace jarol {

void Executor::close(Futex::Time patience) {
  interrupt();
  Use use = Use::free;
  while (!use_.compare_exchange_strong(use, Use::closed, std::memory_order_acquire)) {
    if (use == Use::closed) return;
    if (Futex::now() >= patience) break;
    use = Use::free;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const MemoryScope outside(nullptr);
  const bool real = options_.clock != nullptr;
  const Duration time = real ? Duration(options_.clock->now()) : now();
  if (use == Use::free)
    safe_commands_.hand_over_at_end(channels_, time, !real);
  else
    safe_commands_.fail_at_end(channels_, time, !real, busy_link_text);
}

Finish Executor::finish(std::optional<Futex::Time> patience) {
  if (threads_ != nullptr) {
    const MemoryScope scope(no_heap());
    std::vector<HangingTask> hanging = threads_->drain(patience);
    if (!hanging.empty()) return {false, std::move(hanging)};
    settle(0);
  }
  report_.non_finite_inputs = refused_inputs_;
  for (const auto& channels : channels_) report_.non_finite_inputs += channels->non_finite_inputs();
  return {};
}

const Task* Executor::task_that_runs() const {
  const RunningTask* const running = running_.load(std::memory_order_acquire);
  const TaskMemory* const memory = running != nullptr ? running->memory.load(std::memory_order_relaxed) : nullptr;
  if (memory == nullptr) return nullptr;
  return &graph_.tasks[static_cast<std::size_t>(static_cast<const TaskStatus*>(memory->fault) - plan_.status.data())];
}

std::optional<HangingTask> Executor::running() const {
  const Task* const task = task_that_runs();
  if (task == nullptr) return std::nullopt;
  return HangingTask{task->name, (now() - task->offset) / task->period, now()};
}

std::optional<Holdup> Executor::holdup(Duration end) const {
  if (options_.clock == nullptr || threads_ != nullptr) return std::nullopt;
  const Task* const task = task_that_runs();
  if (task == nullptr) return std::nullopt;
  const Duration instant = now(), time(options_.clock->now());
  return Holdup{.task = {task->name, (instant - task->offset) / task->period, instant},
                .late = time - instant - task->deadline,
                .stops = task->on_fault == OnFault::stop,
                .over = time >= end};
}

}  // namespace jarol
