// Execution times as they are on this machine, and how they get into a graph's file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/commands/run/load_graph.h"

namespace jarol::tools {

struct MeasuredTask {
  std::size_t activations = 0;
  Duration max{};
  Duration max_of_999{};  // at most so long in 99.9 % of the activations, rounded up by a sixteenth at most
};

/// How long the tasks of a graph took, in its order.
struct Measurement {
  Duration over{};  // logical time
  std::vector<MeasuredTask> tasks;
  std::string faults;  // lines that sum up the faulty activations among them
};

/// Runs the graph on the virtual clock up to `end`; per task the processor time of the thread that runs it, so that
/// what preempts it does not count. Its channels are used up. Throws Unfinished if a vehicle in lockstep can't
/// be reached or is lost, or if the machine can't measure so, InputError if a fault stops the run.
Measurement measure_tasks(Loaded& loaded, Duration end);

/// What is written for a measured maximum: with the margin on top, rounded up to three digits.
Duration with_margin(Duration max, double margin);

/// The text of a graph's file with these WCETs in the graph's tasks, everything else as it was: a value that is there
/// is replaced, else `wcet` follows the task's type. Throws InputError for what can't be edited so.
std::string with_wcets(const std::string& text, const GraphSpec& spec, const Graph& graph,
                       const std::vector<std::optional<Duration>>& wcets);

}  // namespace jarol::tools
