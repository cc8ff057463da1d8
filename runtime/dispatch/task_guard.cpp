#include "runtime/dispatch/task_guard.h"

#include <atomic>
#include <cassert>

namespace jarol {
namespace {

std::atomic<TaskGuard*> guard{nullptr};

}  // namespace

TaskGuard::TaskGuard() { guard.store(this); }

TaskGuard::~TaskGuard() { guard.store(nullptr); }

// In the place of what runs the task itself: what keeps its state and takes its heap's measure writes elsewhere, too.
void TaskGuard::take(RunState& state) {
  assert(state.plan.layout.spacing == Spacing::pages);
  state_ = &state;
  for (const Task& task : state.plan.graph.tasks) runs_.push_back(task.task_class->run);
  for (TaskStatus& status : state.status) status.run = &run_guarded;
  for (Activation& activation : state.activations) {
    activation.body = nullptr;
    if (activation.run != &run_with_care) activation.run = &run_guarded;
  }
}

Outcome TaskGuard::run_guarded(const TaskMemory& memory, const Tick& tick) {
  TaskGuard& of = *guard.load(std::memory_order_relaxed);
  const std::uint32_t task = static_cast<const TaskStatus*>(memory.fault)->task;
  const Thunk run = of.runs_[task];
  of.pages_.close(of.state_->pages_of(task));
  const Outcome outcome = run(memory, tick);
  of.pages_.open();
  return outcome;
}

std::optional<TaskGuard::Owner> TaskGuard::find_owner(const void* address) {
  const TaskGuard* const of = guard.load();
  if (of == nullptr || of->state_ == nullptr) return std::nullopt;
  const auto lies_in = [&](std::span<const std::byte> memory) {
    return memory.data() <= address && address < memory.data() + memory.size();
  };
  for (std::uint32_t task = 0; task < of->runs_.size(); ++task) {
    if (lies_in(of->state_->pages_of(task))) return Owner{task, false};
    if (lies_in(of->state_->parameters_of(task))) return Owner{task, true};
  }
  return std::nullopt;
}

}  // namespace jarol
