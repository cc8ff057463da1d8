// What became of a run, or of the replay of one: what its report is made of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "distributers/session/guard.h"
#include "distributers/session/noted.h"
#include "distributers/session/true_state.h"
#include "distributers/session/verdict.h"
#include "runtime/dispatch/stage_team.h"
#include "runtime/execute/attend.h"
#include "runtime/execute/failsafe.h"
#include "runtime/execute/rest.h"
#include "runtime/jarol/jarol_core.h"
#include "runtime/machine/real_clock.h"
#include "runtime/state/run_state.h"

namespace jarol {

/// Of the run that it refers to, which outlives it.
struct RunOutcome {
  const RunState& state;
  const Report& report;
  std::optional<RestReport> rest;
  std::vector<FailsafeReport> failsafe;
  const Noted& noted;
  const RunEnd& end;
  const RealClock* clock = nullptr;    // of exotasks; null: none
  const JarolCore* threads = nullptr;  // null: exotasks; with neither, the virtual clock
  const Guard* guard = nullptr;        // null: the virtual clock
  std::size_t workers = 1;             // that were asked for
  const StageTeam* team = nullptr;     // null: one worker
  std::vector<LinkReport> links{};
  double seconds = 0;  // that it took, above zero
  Duration begun{};    // from which instant on
  Duration simulated{};
  RunVerdict verdict{};
  std::vector<TrueState> true_states{};
  std::string unwritten{};  // why not all that was asked for is written, shown or recorded; empty: it is
  std::string unsaved{};    // why not all is saved that it was to come to; empty: it is

  const Graph& graph() const { return state.plan.graph; }
  const void* last_value(std::size_t communicator) const { return state.last[communicator]; }
  bool in_real_time() const { return clock != nullptr || threads != nullptr; }
};

}  // namespace jarol
