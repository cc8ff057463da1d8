// The executor at the end of a run.
#include <thread>

#include "runtime/execute/executor.h"

namespace jarol {

std::optional<Duration> Executor::begin_rest() {
  if (rest_ == nullptr || report_.stopped || interrupted_.load()) return std::nullopt;
  rest_begun_ = Duration(state_.calendar.next());
  rest_->begin();
  log_rest();
  resting_.store(true);
  return rest_begun_;
}

void Executor::cover_rest() { cover(rest_begun_ + rest_->longest()); }

std::optional<RestReport> Executor::rest() const {
  if (!resting()) return std::nullopt;
  return RestReport{rest_begun_, std::max(rest_begun_, report_.simulated), rest_reached_, rest_->was_heard()};
}

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

const Task* Executor::task_of(const RunningTask* running) const {
  const TaskMemory* const memory = running != nullptr ? running->memory.load(std::memory_order_relaxed) : nullptr;
  if (memory == nullptr) return nullptr;
  return &graph_.tasks[static_cast<std::size_t>(static_cast<const TaskStatus*>(memory->fault) - state_.status.data())];
}

HangingTask Executor::hanging(const Task& task) const {
  return {task.name, (now() - task.offset) / task.period, now()};
}

std::vector<HangingTask> Executor::running() const {
  std::vector<HangingTask> all;
  const auto add = [&](const std::atomic<const RunningTask*>& thread) {
    if (const Task* const task = task_of(thread.load(std::memory_order_acquire))) all.push_back(hanging(*task));
  };
  add(running_);
  if (team_)
    for (const auto& thread : team_->others()) add(thread);
  return all;
}

std::optional<Holdup> Executor::holdup() const {
  if (options_.clock == nullptr || threads_ != nullptr) return std::nullopt;
  const Task* const task = task_of(running_.load(std::memory_order_acquire));
  if (task == nullptr) return std::nullopt;
  const Duration time(options_.clock->now());
  HangingTask held = hanging(*task);
  const Duration late = time - held.instant - task->deadline;
  const bool over = time.count() >= cover_end_.load(std::memory_order_relaxed) && (rest_ == nullptr || resting());
  return Holdup{.task = std::move(held), .late = late, .stops = task->on_fault == OnFault::stop, .over = over};
}

}  // namespace jarol
