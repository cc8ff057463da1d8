// Execution times as they are on this machine, and what they say of a `wcet`.
#pragma once

#include <optional>
#include <vector>

#include "distributers/session/load.h"
#include "runtime/run/report.h"

namespace jarol {

struct MeasuredTask {
  std::size_t activations = 0;
  Duration max{};
  Duration max_of_999{};  // at most so long in 99.9 % of the activations, rounded up by a sixteenth at most
};

/// How long the tasks of a graph took, in its order.
struct Measurement {
  Duration over{};  // logical time
  std::vector<MeasuredTask> tasks;
  Report report;  // faulty activations are among those measured
};

/// Runs the graph on the virtual clock up to `end`, by default that of its missions, else 10 s; per task the processor
/// time of the thread that runs it, so that what preempts it does not count. Its systems are used up. Throws
/// Unfinished if a vehicle in lockstep can't be reached or is lost, or if the machine can't measure so,
/// InputError where a link goes on by itself, or a fault stops the run.
Measurement measure_tasks(Loaded& loaded, std::optional<Duration> end = {});

/// The task that exceeded its `wcet` by most: a verdict is of other times than those of this machine. Null: none did.
const Task* longer_than_stated(const Graph& graph, const Measurement& measurement);

/// What is written for a measured maximum: with the margin on top, rounded up to three digits.
Duration with_margin(Duration max, double margin);

/// A measurement that met no disturbance does not know how long one is, and what it writes must hold when the next one
/// meets it: tasks of a microsecond were seen to take 40 us of processor time on a busy machine.
inline constexpr Duration min_disturbance = std::chrono::microseconds(100);

struct ChosenWcet {
  std::optional<Duration> stated;   // in the file
  std::optional<Duration> written;  // in its place; none: it stays, or was never released
  bool kept = false;                // the one that is stated is no shorter
};

/// Of each task that was measured, for the tasks of a file, whose graph may be another: what 99.9 % of its activations
/// stayed below, and the longest disturbance that any task met, but no less than `min_disturbance`, with the margin on
/// top, 0.2 for 20 %. A `wcet` that is stated stays if it is longer than what was met, unless it may be lowered.
std::vector<ChosenWcet> choose_wcets(const Graph& measured, const Measurement& measurement, const Graph& in_file,
                                     double margin = 0.2, bool lower = false);

}  // namespace jarol
