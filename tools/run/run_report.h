// What a run, or the replay of one, tells at its end.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "distributers/session/guard.h"
#include "runtime/execute/executor.h"
#include "tools/report/commanded.h"
#include "tools/report/noted.h"
#include "tools/report/run_end.h"
#include "tools/report/verdicts.h"

namespace jarol::tools {

struct RunOutcome {
  const Graph& graph;
  const Executor& executor;
  const Noted& noted;
  const RunEnd& end;
  const RealClock* clock = nullptr;  // null: the virtual clock
  const Guard* guard = nullptr;      // null: the virtual clock
  std::size_t workers = 1;           // that were asked for
  std::vector<LinkReport> links{};
  double seconds = 0;  // that it took, above zero
  Duration begun{};    // from which instant on
  Duration simulated{};
  RunVerdict verdict{};
  std::vector<TrueState> true_states{};
};

/// All but the first line.
std::string to_text(const RunOutcome& outcome);
nlohmann::ordered_json to_json(const RunOutcome& outcome);

/// Logical seconds per second.
double real_time_factor(const RunOutcome& outcome);

}  // namespace jarol::tools
