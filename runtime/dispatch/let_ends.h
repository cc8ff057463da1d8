// The ends of LETs, where tasks run on the thread that publishes: outputs are good or not when they are due.
#pragma once

#include "runtime/dispatch/finite.h"
#include "runtime/run/run.h"

namespace jarol {

/// False also where it takes a closer look.
inline bool are_finite(const LetOutputs& outputs) {
  for (const LetValue& v : outputs.values)
    if (!v.finite(v.value)) return false;
  const Range<double>& doubles = outputs.doubles;
  return doubles.first == doubles.last || are_surely_finite(doubles.first, doubles.last);
}

/// Calls publish(what) for the outputs that are due now, in one go where all are good.
template <class Publishing>
[[gnu::always_inline]] inline void end_lets(Run& run, const Now& now, Publishing publish) {
  for (const std::uint32_t g : now.due) {
    const Plan::Group& group = run.plan.groups[g];
    if (group.let_ends.count == 0) continue;
    const LetOutputs& outputs = run.state.let_outputs[g];
    if (run.state.bad_outcomes == 0 && are_finite(outputs)) [[likely]] {
      publish(outputs.publish);
      continue;
    }
    for (const LetEnd& let_end : group.let_ends.of(run.state.let_ends))
      if (run.faults.end_let(let_end, now.instant)) publish(let_end.publish);
  }
}

}  // namespace jarol
