#include "runtime/dispatch/one_by_one.h"

namespace jarol {

BadActivation InTime::operator()(const Activation& activation, const Tick& tick) {
  TaskTiming& timing = clock_.timing(activation.task);
  BadActivation went{.activation = tick.activation, .instant = tick.now};
  if (timing.busy_until > tick.now.count()) {
    ++timing.left_out;
    went.outcome = Outcome::overrun;
    return went;
  }
  const std::int64_t begin = clock_.now();
  went.outcome = activation.run(activation.memory, tick);
  if (went.outcome == Outcome::left_out) return went;
  const std::int64_t end = clock_.now();
  const Duration response(end - tick.now.count());
  timing.busy_until = end;
  timing.execution.add(end - begin);
  timing.response.add(response.count());
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

}  // namespace jarol
