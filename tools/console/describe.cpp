#include "tools/console/describe.h"

#include <nlohmann/json.hpp>

#include "graph/values/bind.h"
#include "runtime/plan/output.h"
#include "tools/console/describe_tasks.h"
#include "tools/console/leaf_text.h"
#include "tools/console/samples_json.h"
#include "tools/console/seconds.h"
#include "tools/drawing/graph/drawing_json.h"
#include "tools/report/tracking.h"

namespace jarol::tools::console {
namespace {

using Json = nlohmann::ordered_json;

std::string plot_kind_of(const Type& type) {
  switch (type.kind) {
    case Kind::boolean: return "bool";
    case Kind::enumeration: return "enum";
    case Kind::sequence:
    case Kind::string: return "text";
    case Kind::signed_integer:
    case Kind::unsigned_integer:
    case Kind::floating:
    case Kind::duration:
    case Kind::array:
    case Kind::structure: return "number";
  }
  return "";
}

Json leaf_json(const Type& type, const Leaf& leaf) {
  Json json{{"path", leaf.path}, {"unit", leaf.unit}, {"kind", plot_kind_of(*leaf.type)}};
  if (leaf.type->kind == Kind::duration) json["unit"] = "ns";
  if (const TypeField* const field = field_of_leaf(type, leaf.path); field != nullptr && !field->text.empty())
    json["text"] = field->text;
  for (std::size_t i = 0; i < leaf.type->enumerators.size(); ++i) {
    const auto& [name, number] = leaf.type->enumerators[i];
    json["words"].push_back({{"number", number}, {"name", name}});
    if (i < leaf.type->meanings.size() && !leaf.type->meanings[i].empty())
      json["words"].back()["meaning"] = leaf.type->meanings[i];
  }
  return json;
}

// `of`: task, communicator or distributer, and its name.
Json output_json(const std::string& name, const Type& type, const char* kind, const std::string& of) {
  auto leaves = Json::array();
  for (const Leaf& leaf : leaves_of(type)) leaves.push_back(leaf_json(type, leaf));
  return {{"name", name}, {"type", type.name}, {"kind", kind}, {"of", of}, {"leaves", std::move(leaves)}};
}

Json outputs_json(const Described& run) {
  auto outputs = Json::array();
  for (const Output& output : outputs_of(run.graph)) {
    const std::size_t dot = output.name.find('.');
    outputs.push_back(output_json(output.name, *output.type, dot == std::string::npos ? "communicator" : "task",
                                  output.name.substr(0, dot)));
  }
  for (std::size_t i = 0; i < run.true_types.size(); ++i) {
    const std::string& name = run.graph.distributers[i].name;
    if (run.true_types[i] == nullptr) {
      outputs.push_back(nullptr);
    } else {
      outputs.push_back(output_json("true " + name, *run.true_types[i], "truth", name));
    }
  }
  return outputs;
}

Json communicators_json(const Graph& graph) {
  auto communicators = Json::array();
  for (const Communicator& c : graph.communicators) {
    Json json{{"name", c.name},
              {"direction", c.direction == Direction::in ? "in" : "out"},
              {"type", c.type->name},
              {"period", seconds(c.period)},
              {"offset", seconds(c.offset)}};
    if (c.timeout) json["timeout"] = seconds(*c.timeout);
    if (c.distributer) json["distributer"] = graph.distributers[*c.distributer].name;
    communicators.push_back(std::move(json));
  }
  return communicators;
}

Json distributers_json(const Graph& graph) {
  auto distributers = Json::array();
  for (const Distributer& d : graph.distributers) {
    const Yaml* const link = d.link.find("type");
    distributers.push_back({{"name", d.name},
                            {"type", d.distributer_class->name},
                            {"summary", d.distributer_class->summary},
                            {"vehicle", d.distributer_class->is_vehicle},
                            {"link", link != nullptr ? link->text : ""}});
    if (const Type* const parameters = d.distributer_class->parameters)
      distributers.back()["parameters"] = describe_parameters(*parameters, d.parameters);
  }
  return distributers;
}

Json connections_json(const Graph& graph) {
  auto connections = Json::array();
  for (const Connection& c : graph.connections)
    connections.push_back(
        {{"from", end_name(graph, c.from, true)}, {"to", end_name(graph, c.to, false)}, {"type", c.type->name}});
  return connections;
}

// Names of leaves as plots call them.
Json pairs_json(const Graph& graph) {
  auto pairs = Json::array();
  for (const Reported& reported : find_reported(graph)) {
    if (!reported.command) continue;
    pairs.push_back(
        {{"title", reported.title},
         {"commanded", graph.communicators[reported.command->communicator].name + "." + reported.command->leaf.path},
         {"reached", graph.communicators[reported.communicator].name + "." + reported.leaf.path}});
  }
  return pairs;
}

}  // namespace

nlohmann::ordered_json describe_run(const Described& run) {
  const Graph& graph = run.graph;
  Json json{{"schema", "jarol.console/1"}, {"graph", graph.name}, {"file", run.file}, {"clock", run.clock}};
  if (const auto& given = run.given)
    json["given"] = {{"file", given->file},
                     {"profile", given->overrides.profile},
                     {"set", given->overrides.set},
                     {"seed", given->seed}};
  if (run.until != Duration::max()) json["until"] = seconds(run.until);
  json["outputs"] = outputs_json(run);
  describe_tasks(graph, json);
  json["communicators"] = communicators_json(graph);
  json["distributers"] = distributers_json(graph);
  json["connections"] = connections_json(graph);
  json["pairs"] = pairs_json(graph);
  json["drawing"] = to_json(lay_out(graph));
  if (run.flow) json["flow"] = {{"of", run.flow->of}, {"north", run.flow->north}, {"east", run.flow->east}};
  return json;
}

}  // namespace jarol::tools::console
