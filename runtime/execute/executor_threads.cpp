// The executor as the dispatcher of threads that run tasks in real time: an instant's work beside the tasks themselves.
#include "runtime/execute/executor.h"
#include "runtime/execute/faults.h"
#include "runtime/execute/publish.h"

namespace jarol {

void Executor::begin_threads() {
  threads_ = std::make_unique<TaskThreads>(state_, *options_.clock, options_.threads);
  under_way_.reserve(graph_.tasks.size());
  // a data-flow task is seen to have ended by its deadline, when others may have published at later instants
  Duration longest{};
  for (const Task& task : graph_.tasks)
    if (!task.let) longest = std::max(longest, task.deadline);
  if (options_.recorder != nullptr) options_.recorder->put_in_order(longest);
}

std::vector<std::string> Executor::refusals() const {
  return threads_ != nullptr ? threads_->refusals() : std::vector<std::string>{};
}

// Data-flow tasks that have ended publish, at the instant of their release: nobody has read since. Those that have not
// ended although somebody may read now are late. A fault with 'stop' ends the run where it is known, before this
// instant.
void Executor::settle(std::int64_t instant) {
  std::size_t left = 0;
  for (const Activation* activation : under_way_) {
    const std::int64_t release = threads_->tick(activation->task).now.count();
    const bool due = instant - release >= graph_.tasks[activation->task].deadline.count();
    const std::optional<Outcome> outcome = threads_->outcome(activation->task, due);
    if (!outcome) {
      under_way_[left++] = activation;
    } else if (*outcome == Outcome::good) {
      publish_in_time(activation->publish, release);
    } else {
      on_bad_outcome_in_time(activation->task, *outcome, release);
    }
  }
  under_way_.resize(left);
}

void Executor::end_let(const LetEnd& let_end, std::int64_t instant) {
  const Outcome outcome = *threads_->outcome(let_end.task, true);
  if (outcome == Outcome::good) {
    publish_in_time(let_end.publish, instant);
  } else if (outcome != Outcome::left_out) {
    on_bad_outcome_in_time(let_end.task, outcome, instant);
  }
}

void Executor::release_on_threads(std::int64_t instant) {
  start_groups(instant);
  for (std::size_t i = 0; i < due_.size(); ++i)
    for (const Activation& activation : plan_.groups[due_[i]].tasks.of(state_.activations)) {
      const Outcome outcome = threads_->add(activation.task, ticks_[i]);
      if (outcome != Outcome::good) --report_.activations;
      if (outcome == Outcome::left_out) ++report_.left_out[activation.task];
      if (outcome == Outcome::overrun) log_miss({ticks_[i].activation, Miss::unknown, activation.task, 1}, instant);
      if (activation.has_let) continue;  // what it was shows at the end of the LET
      if (outcome == Outcome::good) under_way_.push_back(&activation);
      if (outcome == Outcome::overrun) on_bad_outcome_in_time(activation.task, outcome, instant);
    }
  threads_->release();
}

void Executor::publish_in_time(const Publish& what, std::int64_t instant) {
  report_.digest += make_visible<true>(what, digest::instant_term(instant));
  if (options_.recorder != nullptr) record(*options_.recorder, what, instant);
}

void Executor::on_bad_outcome_in_time(std::uint32_t task, Outcome outcome, std::int64_t instant) {
  const Task& t = graph_.tasks[task];
  const std::int64_t activation = threads_->tick(task).activation;
  TaskTiming& timing = options_.clock->timing(task);
  std::string cause;
  if (outcome == Outcome::overrun) {
    ++timing.left_out;
    cause = overrun_text;
  } else if (outcome == Outcome::late) {
    ++timing.late;
    const std::optional<Duration> ended_after = threads_->ended_after(task);
    cause = late_text(ended_after, t.deadline);
    log_late(task, activation, ended_after, instant);
  } else if (outcome == Outcome::non_finite) {
    cause = find_non_finite(*t.task_class->out, threads_->out(task));
  } else {
    cause = state_.status[task].text;
  }
  if (outcome != Outcome::overrun) threads_->undo(task, t.on_fault == OnFault::skip);
  add_fault(task, activation, instant, cause);
}

}  // namespace jarol
