#include "tools/commands/log/report_graph.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "graph/analysis/time_line.h"
#include "graph/text/escape.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<Duration>& duration) { return duration ? Json(duration->count()) : Json(); }

}  // namespace

nlohmann::ordered_json schedule_json(const Graph& graph) {
  if (graph.tasks.empty() || std::any_of(graph.tasks.begin(), graph.tasks.end(), [](const Task& t) { return !t.wcet; }))
    return nullptr;
  const analysis::System system = analysis::system_of(graph);
  const analysis::Result result = analysis::check(graph);
  const analysis::TimeLine line = analysis::time_line_of(system, result);
  Json slices = Json::array();
  for (const analysis::Slice& s : line.slices) slices.push_back({s.task, s.activation, s.begin.count(), s.end.count()});
  return {{"verdict", word_of(result.verdict)}, {"reason", result.reason},        {"utilisation", result.utilisation},
          {"cores", graph.platform.cores},      {"until_ns", line.until.count()}, {"slices", std::move(slices)}};
}

nlohmann::ordered_json tasks_json(const Graph& graph) {
  Json tasks = Json::array();
  for (const std::size_t i : graph.order) {
    const Task& t = graph.tasks[i];
    tasks.push_back({{"index", i},
                     {"name", t.name},
                     {"type", t.task_class->name},
                     {"period_ns", t.period.count()},
                     {"offset_ns", t.offset.count()},
                     {"let_ns", or_null(t.let)},
                     {"deadline_ns", t.deadline.count()},
                     {"wcet_ns", or_null(t.wcet)}});
  }
  return tasks;
}

}  // namespace jarol::tools
