// The graph of a recording.
#pragma once

#include <cstdint>
#include <string>

#include "distributers/session/load.h"
#include "distributers/session/recorded_events.h"
#include "runtime/record/recording.h"

namespace jarol::tools {

/// As the run has read it, or `file` in its place, with the run's overrides and without external systems. A recording
/// names no code: a graph that has plugins is refused unless `file` names it. `command`: what the user is to call then.
/// `with_truth`: what the recording has of where vehicles truly were is known.
Loaded load_recorded_graph(const Recording& recording, const std::string& file, const std::string& command,
                           bool with_truth);

/// The instant of the k-th release of a task.
inline Duration release_of(const Task& task, std::int64_t k) { return task.offset + k * task.period; }
/// Its releases before `end`.
std::int64_t releases_before(const Task& task, Duration end);

}  // namespace jarol::tools
