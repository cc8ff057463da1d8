#include "distributers/campaign/graphs.h"

#include <algorithm>
#include <utility>

#include "graph/campaign/read.h"
#include "runtime/record/recording_format.h"

namespace jarol::campaign {
namespace {

Overrides with(Overrides overrides, const std::vector<std::string>& set) {
  overrides.set.insert(overrides.set.end(), set.begin(), set.end());
  return overrides;
}

}  // namespace

MeasuredGraph::MeasuredGraph(const GraphSource& of) : MeasuredGraph(of, {}, of.known) {}

MeasuredGraph::MeasuredGraph(const GraphSource& of, const std::vector<std::string>& set,
                             const distributers::Registries& known)
    : graph(of.source, known, with(of.overrides, set), of.note), measures(graph.campaign().measures) {
  Problems problems;
  add_metrics(measures, of.metrics, graph.graph(), graph.true_values(), problems);
  problems.throw_if_any();
}

Graphs::Graphs(const GraphSource& of) : source_(of), base_(std::make_shared<const MeasuredGraph>(of)) {}

void Graphs::close(SourceSet::Sources files) { files_ = std::move(files); }

std::shared_ptr<const MeasuredGraph> Graphs::of(const Start& start) {
  const std::vector<std::string> changes = changes_of(start, false);
  if (changes.empty()) return base_;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = others_.find(changes); found != others_.end()) return found->second;
  }
  // what two threads load at once is loaded twice, and nobody waits
  const bool same_plugins = std::none_of(changes.begin(), changes.end(), names_plugins);
  auto made =
      std::make_shared<const MeasuredGraph>(source_, changes, same_plugins ? base_->graph.known() : source_.known);
  const std::lock_guard lock(mutex_);
  if (others_.size() >= max_kept) others_.clear();
  return others_.emplace(changes, std::move(made)).first->second;
}

std::vector<std::string> changes_of(const Start& start, bool of_run) {
  std::vector<std::string> changes;
  for (const std::string& change : start.set)
    if (PlannedGraph::is_of_run(change.substr(0, change.find('='))) == of_run) changes.push_back(change);
  return changes;
}

}  // namespace jarol::campaign
