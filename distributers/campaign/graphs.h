// The graphs of a campaign: one, unless what varies is part of the plan.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/planned_graph.h"
#include "graph/campaign/draws.h"
#include "graph/language/source_set.h"

namespace jarol::campaign {

/// What a campaign runs.
struct GraphSource {
  std::shared_ptr<const Source> source;
  const distributers::Registries& known;
  Overrides overrides;
  std::vector<std::string> metrics{};  // "name=metric", beside those of the file
  NoteSink note = no_notes;
};

/// A graph that is planned, and what is measured of its runs.
struct MeasuredGraph {
  explicit MeasuredGraph(const GraphSource& of);
  /// With these changes; `known` outlives it.
  MeasuredGraph(const GraphSource& of, const std::vector<std::string>& set, const distributers::Registries& known);

  PlannedGraph graph;
  Measures measures;
};

/// Any thread asks.
class Graphs {
 public:
  /// Throws SpecError with all that is wrong with the graph as the file has it.
  explicit Graphs(const GraphSource& of);

  /// From now on all runs get these files, however they change on the disk, and no others.
  void close(SourceSet::Sources files);
  /// None: runs read files as they are by then.
  const std::optional<SourceSet::Sources>& files() const { return files_; }

  const MeasuredGraph& base() const { return *base_; }
  /// The one that a run shares with others. Throws SpecError.
  std::shared_ptr<const MeasuredGraph> of(const Start& start);

 private:
  static constexpr std::size_t max_kept = 64;

  const GraphSource& source_;
  std::optional<SourceSet::Sources> files_;
  std::shared_ptr<const MeasuredGraph> base_;  // those of `others_` use the plugins that it has loaded
  std::mutex mutex_;
  std::map<std::vector<std::string>, std::shared_ptr<const MeasuredGraph>> others_;  // by what differs of the plan
};

/// The changes of a run that are its own, or those that are part of the plan.
std::vector<std::string> changes_of(const Start& start, bool of_run);

}  // namespace jarol::campaign
