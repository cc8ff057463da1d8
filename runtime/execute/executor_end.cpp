// The executor at the end of a run.
#include "runtime/execute/executor.h"

#include <algorithm>

namespace jarol {

void Executor::serialize(Archive& archive) {
  if (clock_ != nullptr) throw NotSaveable("a run on the real clock can't be saved");
  Report& report = run_.report;
  report.non_finite_inputs = communicators_.non_finite_inputs();
  archive(report);
  archive.require(report.covered >= Duration{} && report.covered <= longest_duration &&
                      report.simulated >= Duration{} && report.simulated <= report.covered,
                  "has a time that there is not");
  run_.state.serialize(archive, report.covered);
  communicators_.serialize(archive);
  if (archive.restores()) now_.store(report.simulated);
}

std::optional<Duration> Executor::begin_rest() {
  if (!communicators_.may_rest() || run_.report.stopped || interrupted_.load()) return std::nullopt;
  const Duration begun = run_.state.release_queue.next();
  communicators_.begin_rest(begun);
  return begun;
}

void Executor::close(Futex::Time patience) {
  interrupt();
  communicators_.close(patience, clock_ == nullptr, [this] { return clock_ != nullptr ? clock_->now() : now(); });
}

Finish Executor::finish(std::optional<Futex::Time> patience) {
  std::vector<HangingTask> hanging = dispatcher_->drain(patience);
  if (!hanging.empty()) return {false, std::move(hanging)};
  run_.report.non_finite_inputs = communicators_.non_finite_inputs();
  return {};
}

const Task* Executor::task_of(const RunningTask* running) const {
  const TaskMemory* const memory = running != nullptr ? running->memory.load(std::memory_order_relaxed) : nullptr;
  if (memory == nullptr) return nullptr;
  const TaskStatus* const of_first = run_.state.status.data();
  return &run_.graph.tasks[static_cast<std::size_t>(static_cast<const TaskStatus*>(memory->fault) - of_first)];
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
  for (const auto& thread : dispatcher_->others()) add(thread);
  return all;
}

// Others go on beside it, and keep its last values: being late by itself ends nothing.
std::optional<Holdup> Executor::holdup_of_thread() const {
  std::optional<HangingTask> first = dispatcher_->first_under_way();
  if (!first) return std::nullopt;
  const auto task = std::lower_bound(run_.graph.tasks.begin(), run_.graph.tasks.end(), first->task,
                                     [](const Task& each, const std::string& name) { return each.name < name; });
  if (!task->wcet) return std::nullopt;
  const Duration late = clock_->now() - first->instant - task->deadline;
  return Holdup{.task = std::move(*first), .late = late};
}

std::optional<Call> Executor::call() const {
  const std::optional<std::size_t> called = communicators_.called();
  if (!called) return std::nullopt;
  Call call{{run_.graph.distributers[*called].name, now()}};
  if (clock_ != nullptr) call.patience = communicators_.on_link(*called) ? holdup_patience : lockstep_patience;
  return call;
}

std::optional<Holdup> Executor::holdup() const {
  if (clock_ == nullptr) return std::nullopt;
  if (!dispatcher_->runs_on_caller()) return holdup_of_thread();
  const Task* const task = task_of(running_.load(std::memory_order_acquire));
  if (task == nullptr) return std::nullopt;
  const Duration time = clock_->now();
  HangingTask held = hanging(*task);
  const Duration late = time - held.instant - task->deadline;
  const bool over = time >= cover_end_.load(std::memory_order_relaxed) && (!communicators_.may_rest() || resting());
  return Holdup{.task = std::move(held), .late = late, .stops = task->on_fault == OnFault::stop, .over = over};
}

}  // namespace jarol
