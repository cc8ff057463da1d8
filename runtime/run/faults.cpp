#include "runtime/run/faults.h"

#include "runtime/plan/layout.h"
#include "runtime/run/fault_text.h"

namespace jarol {

Faults::Faults(RunState& state, Report& report, Publisher& publisher, InputLog& log)
    : graph_(state.plan.graph), state_(state), report_(report), publisher_(publisher), log_(log) {}

std::string Faults::cause_of(std::uint32_t task, const BadActivation& bad, const void* out) const {
  const Task& t = graph_.tasks[task];
  switch (bad.outcome) {
    case Outcome::overrun: return overrun_text;
    case Outcome::late: return late_text(bad.ended_after, t.deadline);
    case Outcome::non_finite: return find_non_finite(*t.task_class->out, out);
    case Outcome::out_of_range: return find_out_of_range(*t.task_class->out, out);
    case Outcome::good:
    case Outcome::left_out:
    case Outcome::threw:
    case Outcome::heap_exhausted: break;
  }
  return state_.status[task].text;
}

void Faults::on_bad(const Activation& activation, const BadActivation& bad) {
  const std::uint32_t task = activation.task;
  TaskStatus& status = state_.status[task];
  if (activation.has_let) {
    state_.outcomes[task] = bad.outcome;
    ++state_.bad_outcomes;
  }
  if (bad.outcome == Outcome::left_out || bad.outcome == Outcome::overrun) --report_.activations;
  if (bad.outcome == Outcome::left_out) {
    ++report_.left_out[task];
    return;
  }
  if (bad.outcome == Outcome::overrun) log_.left_out(task, bad.activation, bad.instant);
  if (bad.outcome == Outcome::late) log_.late(task, bad.activation, bad.ended_after, bad.instant);
  const bool says_why = bad.outcome == Outcome::threw || bad.outcome == Outcome::heap_exhausted;
  if (!says_why) keep_text(status, cause_of(task, bad, activation.memory.out));
  status.activation = bad.activation;
  if (bad.outcome == Outcome::overrun) {
    status.skip_next = false;  // this was the one to skip
  } else {
    restore(activation, bad.ran);
  }
  if (!activation.has_let) add_noted(task, bad.instant);
}

void Faults::restore(const Activation& activation, bool ran) {
  const OnFault on_fault = graph_.tasks[activation.task].on_fault;
  if (on_fault == OnFault::stop) return;
  TaskStatus& status = state_.status[activation.task];
  if (ran) status.restore(activation.memory.state);
  status.skip_next = on_fault == OnFault::skip;
  status.begins_anew = on_fault == OnFault::restart;
}

bool Faults::end_let(const LetEnd& let_end, Duration instant) {
  Outcome& outcome = state_.outcomes[let_end.task];
  if (outcome == Outcome::good) {
    if (!has_late_fault(let_end, instant)) return true;
    add_noted(let_end.task, instant);
    return false;
  }
  if (outcome != Outcome::left_out) add_noted(let_end.task, instant);
  outcome = Outcome::good;  // at most one activation waits for its end
  --state_.bad_outcomes;
  return false;
}

// Looks at the outputs of a task that are checked at the end of its LET.
bool Faults::has_late_fault(const LetEnd& let_end, Duration instant) {
  const Task& task = graph_.tasks[let_end.task];
  const Type& type = *task.task_class->out;
  if (!is_checked_at_let_end(task) || type.finite(let_end.out)) return false;
  TaskStatus& status = state_.status[let_end.task];
  keep_text(status, find_non_finite(type, let_end.out));
  status.activation = (instant - *task.let - task.offset) / task.period;
  return true;
}

void Faults::add(std::uint32_t task, const BadActivation& bad, const void* out) {
  add(task, bad.activation, bad.instant, cause_of(task, bad, out));
}

// What the task's status says.
void Faults::add_noted(std::uint32_t task, Duration instant) {
  add(task, state_.status[task].activation, instant, state_.status[task].text);
}

void Faults::add(std::uint32_t task, std::int64_t activation, Duration instant, std::string_view cause) {
  const Task& of = graph_.tasks[task];
  ++report_.left_out[task];
  const bool by_limit = of.fault_limit && reaches_limit(task, activation);
  std::string longer;
  if (by_limit) cause = longer = std::string(cause) + limit_text(*of.fault_limit);
  report_.add({of.name, activation, instant, cause});
  publisher_.show({RunEvent::Kind::fault, instant, task, activation, cause});
  if (of.on_fault == OnFault::stop || by_limit) report_.stopped = true;
}

// Remembers the fault; those that are too old to count with it are forgotten.
bool Faults::reaches_limit(std::uint32_t task, std::int64_t activation) {
  const FaultLimit& limit = *graph_.tasks[task].fault_limit;
  std::vector<std::int64_t>& recent = state_.recent_faults[task];
  std::erase_if(recent, [&](std::int64_t earlier) { return activation - earlier >= limit.releases; });
  recent.push_back(activation);
  if (recent.size() < static_cast<std::size_t>(limit.faults)) return false;
  recent.clear();
  return true;
}

}  // namespace jarol
