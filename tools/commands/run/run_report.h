// What a run, or the replay of one, reports at its end.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/guard.h"
#include "runtime/dispatch/stage_team.h"
#include "runtime/jarol/jarol_core.h"
#include "runtime/machine/real_clock.h"
#include "tools/report/noted.h"
#include "tools/report/run_end.h"
#include "tools/report/tracking.h"
#include "tools/report/verdicts.h"

namespace jarol::tools {

struct RunOutcome {
  const RunState& state;
  const Report& report;
  std::optional<RestReport> rest;
  const std::vector<FailsafeReport>& failsafe;
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

  const Graph& graph() const { return state.plan.graph; }
  const void* last_value(std::size_t communicator) const { return state.last[communicator]; }
  bool in_real_time() const { return clock != nullptr || threads != nullptr; }
};

/// All but the first line.
std::string to_text(const RunOutcome& outcome);
nlohmann::ordered_json to_json(const RunOutcome& outcome);

/// Logical seconds per second.
double real_time_factor(const RunOutcome& outcome);

}  // namespace jarol::tools
