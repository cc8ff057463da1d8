#include "runtime/dispatch/one_by_one.h"

namespace jarol {

BadActivation InTime::operator()(const Activation& activation, const Tick& tick) {
  TaskTiming& timing = clock_.timing(activation.task);
  BadActivation went{.activation = tick.activation, .instant = tick.now};
  if (timing.busy_until > tick.now) {
    ++timing.left_out;
    went.outcome = Outcome::overrun;
    return went;
  }
  const Duration begin = clock_.now();
  went.outcome = activation.run(activation.memory, tick);
  if (went.outcome == Outcome::left_out) return went;
  const Duration end = clock_.now();
  const Duration response = end - tick.now;
  timing.busy_until = end;
  timing.execution.add(end - begin);
  timing.response.add(response);
  if (went.outcome != Outcome::good || response <= graph_.tasks[activation.task].deadline) return went;
  ++timing.late;
  went.outcome = Outcome::late;
  went.ended_after = response;
  return went;
}

// What was late or left out has the same effect whether it runs or not.
BadActivation AsLogged::operator()(const Activation& activation, const Tick& tick) {
  BadActivation went{.activation = tick.activation, .instant = tick.now};
  const Miss* const miss = missed_.find(activation.task, tick.activation);
  if (miss == nullptr) {
    went.outcome = activation.run(activation.memory, tick);
  } else if (miss->left_out != 0) {
    went.outcome = Outcome::overrun;
  } else {
    went.outcome = Outcome::late;
    went.ran = false;
    if (miss->ended_after != Miss::unknown) went.ended_after = Duration(miss->ended_after);
  }
  return went;
}

std::optional<BadActivation> find_miss(analysis::Schedule& schedule, std::uint32_t task, const Tick& tick) {
  const analysis::Fate& fate = schedule.fate(task, tick.activation);
  BadActivation missed{.activation = tick.activation, .instant = tick.now};
  switch (fate.kind) {
    case analysis::Fate::Kind::in_time: return std::nullopt;
    case analysis::Fate::Kind::left_out: missed.outcome = Outcome::overrun; break;
    case analysis::Fate::Kind::late:
      missed.outcome = Outcome::late;
      missed.ran = false;
      if (fate.response) missed.ended_after = *fate.response;
      break;
  }
  return missed;
}

BadActivation AsScheduled::operator()(const Activation& activation, const Tick& tick) {
  if (const auto missed = find_miss(schedule_, activation.task, tick)) return *missed;
  return {activation.run(activation.memory, tick), tick.activation, tick.now};
}

}  // namespace jarol
