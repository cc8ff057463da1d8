// What commands that run in real time share: their options, what they refuse, and what they report afterwards.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/run_words.h"
#include "graph/model/graph.h"
#include "runtime/execute/failsafe.h"
#include "runtime/external_system.h"
#include "runtime/machine/real_clock.h"
#include "runtime/run/ending.h"

namespace jarol::tools {

class Command;

struct RealTimeArguments {
  int priority = 0;  // 0: the ordinary scheduler
  std::string cpus;
  bool spin = false;
  bool force = false;
  bool no_guardian = false;
};

void add_real_time_options(Command& command, RealTimeArguments& arguments);

/// Throws InputError for a bad list of CPUs.
RealTimeOptions options_of(const RealTimeArguments& arguments);

/// How messages of runs name what the command line has.
extern const RunWords run_words;

/// How well the run kept to real time.
std::string to_text(const Graph& graph, const RealClock& clock);
nlohmann::ordered_json to_json(const Graph& graph, const RealClock& clock);

/// When safe values were handed over, and why at the end; in the text only those that were.
std::string to_text(const Graph& graph, const std::vector<FailsafeReport>& failsafe, const Ending& ending);
nlohmann::ordered_json to_json(const Graph& graph, const std::vector<FailsafeReport>& failsafe);
/// Of what could not be handed over at the end though somebody had been there.
int exit_code_of(const std::vector<FailsafeReport>& failsafe);

/// What a link has carried; in the text only what there was, and whether nobody was heard.
std::string to_text(const LinkReport& link);
nlohmann::ordered_json to_json(const LinkReport& link);

}  // namespace jarol::tools
