// The executor where an activation was not good.
#include "runtime/execute/executor.h"
#include "runtime/execute/faults.h"
#include "runtime/plan/layout.h"

namespace jarol {

std::string to_text(const Fault& fault) {
  return "task '" + fault.task + "' activation " + std::to_string(fault.activation) + " at " +
         seconds_text(fault.instant) + " s: " + fault.cause;
}

// Looks at the outputs of a task that are checked at the end of its LET.
bool Executor::has_late_fault(const LetEnd& let_end, std::int64_t instant) {
  const Task& task = graph_.tasks[let_end.task];
  const Type& type = *task.task_class->out;
  if (!is_checked_at_let_end(task) || type.finite(let_end.out)) return false;
  TaskStatus& status = state_.status[let_end.task];
  keep_text(status, find_non_finite(type, let_end.out));
  status.activation = (Duration(instant) - *task.let - task.offset) / task.period;
  return true;
}

// A LET task's fault shows at the end of its LET, when its outputs would have.
void Executor::on_bad_outcome(const Activation& activation, Outcome outcome, const Tick& tick) {
  const Task& task = graph_.tasks[activation.task];
  TaskStatus& status = state_.status[activation.task];
  if (activation.has_let) {
    state_.outcomes[activation.task] = outcome;
    ++state_.bad_outcomes;
  }
  if (outcome == Outcome::left_out) {
    --report_.activations;
    ++report_.left_out[activation.task];
    return;
  }
  if (outcome == Outcome::overrun) {
    --report_.activations;
    keep_text(status, overrun_text);
    log_miss({tick.activation, Miss::unknown, activation.task, 1}, tick.now.count());
  } else if (outcome == Outcome::late) {
    keep_text(status, late_text(ended_after_, task.deadline));
    log_late(activation.task, tick.activation, ended_after_, tick.now.count());
  } else if (outcome == Outcome::non_finite) {
    keep_text(status, find_non_finite(*task.task_class->out, activation.memory.out));
  }
  status.activation = tick.activation;
  if (outcome == Outcome::overrun) {
    status.skip_next = false;  // this was the one to skip
  } else if (task.on_fault != OnFault::stop) {
    // what is late in a replay has not run
    if (missed_ == nullptr || outcome != Outcome::late) status.put_back(activation.memory.state);
    status.skip_next = task.on_fault == OnFault::skip;
  }
  if (!activation.has_let) record_fault(activation.task, tick.now.count());
}

void Executor::record_fault(std::uint32_t task, std::int64_t instant) {
  const TaskStatus& status = state_.status[task];
  add_fault(task, status.activation, instant, status.text);
}

void Executor::add_fault(std::uint32_t task, std::int64_t activation, std::int64_t instant, const std::string& cause) {
  ++report_.left_out[task];
  report_.add({graph_.tasks[task].name, activation, Duration(instant), cause});
  if (graph_.tasks[task].on_fault == OnFault::stop) report_.stopped = true;
}

}  // namespace jarol
