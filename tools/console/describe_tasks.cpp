#include "tools/console/describe_tasks.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "graph/analysis/time_line.h"
#include "graph/values/bind.h"
#include "tools/console/leaf_text.h"
#include "tools/console/seconds.h"
#include "tools/report/value_json.h"

namespace jarol::tools::console {
namespace {

using Json = nlohmann::ordered_json;

const char* kind_of(const Type& type) {
  switch (type.kind) {
    case Kind::boolean: return "bool";
    case Kind::enumeration: return "enum";
    case Kind::signed_integer:
    case Kind::unsigned_integer: return "integer";
    case Kind::floating: return "number";
    case Kind::duration:
    case Kind::array:
    case Kind::structure:
    case Kind::sequence:
    case Kind::string: return "text";
  }
  return "";
}

}  // namespace

Json describe_parameters(const Type& type, const Value& given) {
  auto parameters = Json::array();
  const Value defaults(type);
  for (const Leaf& leaf : leaves_of(type)) {
    const auto text_in = [&](const Value& value) {
      return graph_text(*leaf.type, static_cast<const std::byte*>(value.data()) + leaf.offset);
    };
    Json json{{"path", leaf.path},
              {"kind", kind_of(*leaf.type)},
              {"unit", leaf.unit},
              {"value", text_in(given)},
              {"default", text_in(defaults)}};
    if (const TypeField* const field = field_of_leaf(type, leaf.path); field != nullptr) {
      if (!field->text.empty()) json["text"] = field->text;
      // of durations, which are texts here, ranges are in nanoseconds
      const bool is_number = leaf.type->kind != Kind::duration;
      if (is_number && std::isfinite(field->range.min)) json["min"] = field->range.min;
      if (is_number && std::isfinite(field->range.max)) json["max"] = field->range.max;
    }
    for (const auto& [name, number] : leaf.type->enumerators) json["words"].push_back(name);
    parameters.push_back(std::move(json));
  }
  return parameters;
}

namespace {

Json task_json(const Task& task) {
  Json json{{"name", task.name},
            {"type", task.task_class->name},
            {"period", seconds(task.period)},
            {"offset", seconds(task.offset)},
            {"deadline", seconds(task.deadline)},
            {"parameters", describe_parameters(*task.task_class->parameters, task.parameters)}};
  if (task.let) json["let"] = seconds(*task.let);
  if (task.wcet) json["wcet"] = seconds(*task.wcet);
  return json;
}

Json analysis_json(const Graph& graph, const analysis::Result& result) {
  const analysis::TimeLine line =
      analysis::time_line_of(analysis::system_of(graph), result, {.until_it_repeats = true, .max_activations = 3000});
  auto slices = Json::array();
  for (const analysis::Slice& slice : line.slices)
    slices.push_back({slice.task, seconds(slice.begin), seconds(slice.end)});
  Json json{{"until", seconds(line.until)}, {"slices", std::move(slices)}};
  if (line.round) json["round"] = seconds(*line.round);
  return json;
}

}  // namespace

void describe_tasks(const Graph& graph, Json& to) {
  const analysis::Result result = analysis::check(graph);
  auto& tasks = to["tasks"] = Json::array();
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    Json json = task_json(graph.tasks[i]);
    if (result.response.size() > i && result.response[i])
      json["slack"] = seconds(graph.tasks[i].deadline - *result.response[i]);
    if (result.core.size() > i && result.core[i]) json["core"] = *result.core[i];
    tasks.push_back(std::move(json));
  }
  to["verdict"] = {{"kind", word_of(result.verdict)}, {"reason", result.reason}};
  const bool stated = std::all_of(graph.tasks.begin(), graph.tasks.end(), [](const Task& t) { return t.wcet; });
  if (stated && !graph.tasks.empty() && result.core.size() == graph.tasks.size())
    to["schedule"] = analysis_json(graph, result);
}

}  // namespace jarol::tools::console
