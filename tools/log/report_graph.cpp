#include "tools/log/report_graph.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "graph/analysis/time_line.h"
#include "graph/text/escape.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string timing_text(Duration period, Duration offset) {
  return duration_text(period) + (offset.count() > 0 ? " + " + duration_text(offset) : "");
}

Json or_null(const std::optional<Duration>& duration) { return duration ? Json(duration->count()) : Json(); }

}  // namespace

nlohmann::ordered_json drawing_json(const Graph& graph) {
  Json nodes = Json::array(), edges = Json::array();
  for (const Distributer& d : graph.distributers)
    nodes.push_back(
        {{"id", "world " + d.name}, {"kind", "world"}, {"name", d.name}, {"type", d.distributer_class->name}});
  for (const Communicator& c : graph.communicators) {
    const bool in = c.direction == Direction::in;
    const std::string id = "communicator " + c.name;
    nodes.push_back({{"id", id},
                     {"kind", in ? "in" : "out"},
                     {"name", c.name},
                     {"type", c.type->name},
                     {"timing", timing_text(c.period, c.offset)}});
    if (!c.distributer) continue;
    const Distributer& d = graph.distributers[*c.distributer];
    const std::string world = "world " + d.name, channel = d.distributer_class->channels[c.channel].name;
    edges.push_back({{"from", in ? world : id}, {"to", in ? id : world}, {"label", channel}, {"outside", true}});
  }
  for (const Task& t : graph.tasks)
    nodes.push_back({{"id", "task " + t.name},
                     {"kind", "task"},
                     {"name", t.name},
                     {"type", t.task_class->name},
                     {"timing", timing_text(t.period, t.offset)},
                     {"let", t.let ? Json(duration_text(*t.let)) : Json()}});
  const auto id_of = [&](const End& end) {
    return end.kind == End::Kind::task ? "task " + graph.tasks[end.index].name
                                       : "communicator " + graph.communicators[end.index].name;
  };
  for (const Connection& c : graph.connections)
    edges.push_back({{"from", id_of(c.from)},
                     {"to", id_of(c.to)},
                     {"label", end_name(graph, c.from, true) + " → " + end_name(graph, c.to, false)}});
  return {{"nodes", std::move(nodes)}, {"edges", std::move(edges)}};
}

nlohmann::ordered_json schedule_json(const Graph& graph) {
  if (graph.tasks.empty() || std::any_of(graph.tasks.begin(), graph.tasks.end(), [](const Task& t) { return !t.wcet; }))
    return nullptr;
  const analysis::System system = analysis::system_of(graph);
  const analysis::Result result = analysis::check(system);
  const analysis::TimeLine line = analysis::time_line_of(system, result);
  Json slices = Json::array();
  for (const analysis::Slice& s : line.slices) slices.push_back({s.task, s.activation, s.begin, s.end});
  return {{"verdict", word_of(result.verdict)}, {"reason", result.reason}, {"utilisation", result.utilisation},
          {"cores", graph.platform.cores},      {"until_ns", line.until},  {"slices", std::move(slices)}};
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
