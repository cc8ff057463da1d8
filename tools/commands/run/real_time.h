// What commands that run in real time share: their options, what they refuse, and what they report afterwards.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/analysis/threads.h"
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

/// Throws std::invalid_argument for a bad list of CPUs.
RealTimeOptions options_of(const RealTimeArguments& arguments);

/// Gives the calling thread that priority under SCHED_FIFO, and those that it makes from now on, as the threads of
/// links.
void take_priority(std::optional<int> priority);

/// The threads that run tasks, where it takes more than the one that keeps the time; completes the options for them.
/// Throws std::invalid_argument where this machine has too few CPUs, or SCHED_FIFO too few priorities.
std::vector<analysis::TaskThread> threads_for(const std::string& file, const Graph& graph, RealTimeOptions& options);

/// Throws std::invalid_argument for a graph that can't be executed in real time, and unless forced NegativeVerdict for
/// one of which check finds that it is not schedulable or breaks a chain's limit; says on stderr when check can't
/// report. `file` is what the user called the graph.
void require_executable(const std::string& file, const Graph& graph, const RealTimeArguments& arguments);

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
