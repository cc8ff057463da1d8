#include "tools/commands/log/recorded_graph.h"

#include "distributers/session/replay_start.h"
#include "graph/language/source_set.h"
#include "tools/commands/run/load_graph.h"

namespace jarol::tools {

Loaded load_recorded_graph(const Recording& recording, const std::string& file, const std::string& command,
                           bool with_truth) {
  Overrides overrides = recording.header().overrides;
  const RecordingHeader* const recorded = with_truth ? &recording.header() : nullptr;
  if (!file.empty()) return load_without_systems(file, overrides, recorded);
  overrides.no_plugins =
      "the recording names this graph, and a recording names no code; name it yourself: " + command + " FILE GRAPH";
  SourceSet sources;
  give_recorded(recording, overrides, command + " FILE GRAPH", sources);
  return load_without_systems(recording.header().file, overrides, recorded);
}

std::int64_t releases_before(const Task& task, Duration end) {
  return end <= task.offset ? 0 : (end - task.offset - Duration(1)) / task.period + 1;
}

}  // namespace jarol::tools
