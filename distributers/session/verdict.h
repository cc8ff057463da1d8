// Whether a run did what it was meant to do: what the graph expects of it, what became of its vehicles, and how much of
// it was left out.
#pragma once

#include <string>
#include <vector>

#include "distributers/session/run_sinks.h"
#include "graph/model/graph.h"
#include "runtime/execute/executor.h"
#include "runtime/execute/expectations.h"
#include "runtime/external_system.h"

namespace jarol {

struct RunVerdict {
  std::vector<Verdict> expectations;
  struct VehicleMishap {
    std::string distributer;
    std::string text;
  };
  std::vector<VehicleMishap> mishaps;
  std::string stopped{};  // why a session did not come to its end: a fault, a lost system, no vehicle; empty: it did
  std::string not_at_rest{};          // why its vehicle did not come to rest at its end; empty: it did, or was not to
  std::vector<std::string> left_out;  // per task with more faults than the graph allows: a line
  std::string unseen{};  // why a session did not get all that was published, so that what was lost is neither judged
                         // nor kept; empty: it did
  std::vector<std::string> unheard{};  // distributers on links whose vehicle sent nothing that counts, in the whole run

  bool is_negative() const;
};

/// "the vehicle of 'robostix' has crashed: a rotor met the ground, at 10.32 s".
std::string to_text(const RunVerdict::VehicleMishap& mishap);

/// What became of the vehicles that are simulated in these systems, one per distributer of the graph; so too where the
/// run came to rest by what its graph believes, and the vehicle did not.
std::vector<RunVerdict::VehicleMishap> find_mishaps(const Graph& graph, const std::vector<ExternalSystem*>& systems,
                                                    const std::optional<RestReport>& rest);

/// Shows that to those who look on at a run that is over, and closes them. Throws what a sink threw.
void show_mishaps_and_close(RunSinks& sinks, const Graph& graph, const std::vector<ExternalSystem*>& systems,
                            const Report& report, const std::optional<RestReport>& rest);

/// The distributers of vehicles from which nothing came over their links, though the graph takes something from them.
std::vector<std::string> find_unheard(const Graph& graph, const std::vector<ExternalSystem*>& systems);

/// A line for each task that faults left without outputs more often than the graph allows.
std::vector<std::string> find_left_out(const Graph& graph, const Report& report);

/// Why what is expected by the end may still have been to come, in a run that was to go on `until` and whose mission
/// ends at `mission`; else empty.
std::string why_cut_short(Duration reached, Duration until, Duration mission);

/// Of all scripts among these systems; zero: there is none.
Duration end_of_mission(const std::vector<ExternalSystem*>& systems);

/// All of that, of a run that was to go on `until`, came to rest or not, and ended like that; its sinks are closed.
RunVerdict judge_run(const Graph& graph, const Report& report, const std::vector<ExternalSystem*>& systems,
                     const RunSinks& sinks, const std::optional<RestReport>& rest, Duration until, const RunEnd& end);

}  // namespace jarol
