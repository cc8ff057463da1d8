#include "tools/report/graph_schema.h"

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "graph/language/tables.h"
#include "tools/report/key_schema.h"
#include "tools/report/link_schema.h"
#include "tools/report/value_schema.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;

const std::string end_pattern = "[A-Za-z_][A-Za-z0-9_]*(\\.[A-Za-z_][A-Za-z0-9_]*)?";
const std::string arrow_pattern = "^ *" + end_pattern + " *-> *" + end_pattern + " *$";

Json reference(const std::string& name) { return {{"$ref", "#/definitions/" + name}}; }

// A section of named entries.
Json entries_schema(Json entry) {
  return {
      {"type", "object"}, {"patternProperties", {{name_pattern, std::move(entry)}}}, {"additionalProperties", false}};
}

Json texts() { return {{"type", "array"}, {"items", {{"type", "string"}, {"minLength", 1}}}}; }

void describe_section(Json& schema, const std::string& name, Json section) {
  section["description"] = schema["properties"][name]["description"];
  schema["properties"][name] = std::move(section);
}

// What each task type lets one write; others may be a plugin's.
Json task_schema(const Registry& known, Json& definitions) {
  Json schema = mapping_schema(task_keys()), names = Json::array(), rules = Json::array();
  for (const TaskClass& task : known.tasks()) {
    names.push_back({{"const", task.name}, {"description", task.summary}});
    definitions["task." + task.name] = {
        {"properties", {{"parameters", fields_schema(*task.parameters)}, {"init", fields_schema(*task.out)}}}};
    rules.push_back({{"if", {{"properties", {{"type", {{"const", task.name}}}}}, {"required", {"type"}}}},
                     {"then", reference("task." + task.name)}});
  }
  names.push_back({{"type", "string"}});
  schema["properties"]["type"]["anyOf"] = std::move(names);
  schema["allOf"] = std::move(rules);
  return schema;
}

// The directions and types of all channels of one name.
struct ChannelEnds {
  std::set<std::string> in, out;
};

Json any_value(const std::set<std::string>& types) {
  if (types.empty()) return false;
  Json any = Json::array();
  for (const std::string& type : types) any.push_back(reference("value." + type));
  return any.size() == 1 ? any[0] : Json{{"anyOf", std::move(any)}};
}

// A communicator with a channel has what channels of that name have; one without says its type and direction.
Json communicator_schema(const Registry& known, Json& definitions) {
  std::map<std::string, ChannelEnds> channels;
  for (const DistributerClass& distributer : known.distributers())
    for (const ChannelClass& c : distributer.channels)
      (c.direction == Direction::in ? channels[c.name].in : channels[c.name].out).insert(c.type->name);
  std::string names;
  Json rules = Json::array();
  for (const auto& [name, of] : channels) {
    names += (names.empty() ? "" : "|") + name;
    Json values{{"init", any_value(of.in)}, {"safe", any_value(of.out)}};
    if (of.in.empty()) values["timeout"] = false;
    rules.push_back(
        {{"if", {{"properties", {{"channel", {{"pattern", "\\." + name + "$"}}}}}, {"required", {"channel"}}}},
         {"then", {{"properties", std::move(values)}}}});
  }
  for (const std::string& name : known.type_names()) {
    definitions["value." + name] = value_schema(*known.find_type(name), "");
    rules.push_back({{"if",
                      {{"properties", {{"type", {{"const", name}}}, {"direction", {{"const", "in"}}}}},
                       {"required", {"type", "direction"}}}},
                     {"then", {{"properties", {{"init", reference("value." + name)}}}}}});
  }
  rules.push_back({{"if", {{"properties", {{"direction", {{"const", "out"}}}}}, {"required", {"direction"}}}},
                   {"then", {{"properties", {{"init", false}}}}}});
  Json schema = mapping_schema(communicator_keys());
  schema["properties"]["channel"]["pattern"] = "^[A-Za-z_][A-Za-z0-9_]*\\.(" + names + ")$";
  schema["if"] = {{"required", {"channel"}}};
  schema["then"] = {{"properties", {{"type", false}, {"direction", false}}}};
  schema["else"] = {{"required", {"type", "direction"}}, {"properties", {{"timeout", false}, {"safe", false}}}};
  schema["dependencies"] = {{"timeout", {"channel"}}, {"safe", {"channel"}}};
  schema["allOf"] = std::move(rules);
  return schema;
}

Json chain_schema() {
  Json schema = mapping_schema(chain_keys());
  schema["properties"]["path"].update(
      {{"type", "array"}, {"items", {{"type", "string"}, {"pattern", name_pattern}}}, {"minItems", 2}});
  return schema;
}

// Policies or grammars; others may be a plugin's.
template <class C>
Json names_schema(const std::vector<C>& classes) {
  Json names = Json::array();
  for (const C& c : classes) names.push_back({{"const", c.name}, {"description", c.how}});
  names.push_back({{"type", "string"}});
  return names;
}

Json platform_schema(const Registry& known) {
  Json schema = mapping_schema(platform_keys());
  schema["properties"]["policy"]["anyOf"] = names_schema(known.policies());
  return schema;
}

Json timing_schema(const Registry& known) {
  Json schema = mapping_schema(timing_keys());
  schema["properties"]["grammar"]["anyOf"] = names_schema(known.grammars());
  return schema;
}

Json at_end_schema() {
  Json schema = mapping_schema(at_end_keys());
  schema["properties"]["command"]["minProperties"] = 1;
  schema["properties"]["until"].update({{"type", "string"}, {"minLength", 1}});
  return schema;
}

Json campaign_schema() {
  Json schema = mapping_schema(campaign_keys());
  const Json list{{"type", "array"}, {"items", {{"type", {"string", "number", "boolean", "null"}}}}, {"minItems", 1}};
  const Json text{{"type", "string"}, {"pattern", "^ *normal\\(|^ *grid\\(|\\.\\."}};
  const Json seeds{{"type", "array"}, {"items", {{"type", "integer"}, {"minimum", 0}}}, {"minItems", 1}};
  const Json from_to{{"type", "string"}, {"pattern", "^ *[0-9]+ *\\.\\. *[0-9]+ *$"}};
  schema["properties"]["vary"]["properties"]["seed"] = {{"anyOf", {from_to, seeds}}};
  schema["properties"]["vary"]["additionalProperties"] = {{"anyOf", {text, list}}};
  schema["properties"]["metrics"].update(
      {{"patternProperties", {{name_pattern, {{"type", "string"}, {"minLength", 1}}}}},
       {"additionalProperties", false}});
  return schema;
}

// A graph is of something.
Json some_of(const std::string& section) {
  return {{"required", Json::array({section})}, {"properties", {{section, {{"minProperties", 1}}}}}};
}

// Without plugins there are no task types, types of values, policies and grammars but those that are known here.
Json without_plugins(const Registry& known) {
  Json tasks{{"type", {{"enum", names_of(known.tasks())}}}}, values{{"type", {{"enum", known.type_names()}}}};
  const auto each = [](Json properties) {
    return Json{{"additionalProperties", {{"properties", std::move(properties)}}}};
  };
  const Json platform{{"properties", {{"policy", {{"enum", names_of(known.policies())}}}}}};
  const Json timing{{"properties", {{"grammar", {{"enum", names_of(known.grammars())}}}}}};
  return {{"if", {{"required", {"plugins"}}}},
          {"else",
           {{"properties",
             {{"tasks", each(std::move(tasks))},
              {"communicators", each(std::move(values))},
              {"platform", platform},
              {"timing", timing}}}}}};
}

// A profile sets what the rest of the graph says, not what profiles say.
Json profiles_schema() {
  return {{"type", "object"},
          {"additionalProperties", {{"type", "object"}, {"propertyNames", {{"pattern", "^(?!profiles(\\.|$))"}}}}}};
}

// Those of grammars take any value: each says itself what is wrong with it.
void add_grammar_keys(Json& schema, const Registry& known) {
  for (const Grammar& grammar : known.grammars())
    for (const GrammarKey& key : grammar.keys) {
      const std::string section(key.section);
      if (!schema["properties"].contains(section)) continue;
      Json& of = schema["properties"][section];
      Json& holder = of.contains("patternProperties") ? of["patternProperties"][name_pattern] : of;
      holder["properties"][std::string(key.name)] = {{"description", key.text}};
    }
}

}  // namespace

std::string graph_schema(const distributers::Registries& known) {
  Json schema = mapping_schema(graph_keys()), definitions = link_schemas(known);
  describe_section(schema, "timing", timing_schema(known.graph));
  describe_section(schema, "plugins", texts());
  describe_section(schema, "distributers", entries_schema(distributer_schema(known)));
  describe_section(schema, "communicators", entries_schema(communicator_schema(known.graph, definitions)));
  describe_section(schema, "tasks", entries_schema(task_schema(known.graph, definitions)));
  describe_section(schema, "connections",
                   {{"type", "array"}, {"items", {{"type", "string"}, {"pattern", arrow_pattern}}}});
  describe_section(schema, "chains", entries_schema(chain_schema()));
  describe_section(schema, "platform", platform_schema(known.graph));
  describe_section(schema, "at_end", at_end_schema());
  describe_section(schema, "campaign", campaign_schema());
  describe_section(schema, "expect", {{"anyOf", {texts(), {{"const", "nothing"}}}}});
  describe_section(schema, "profiles", profiles_schema());
  add_grammar_keys(schema, known.graph);
  schema["anyOf"] = Json::array({some_of("tasks"), some_of("communicators"), some_of("distributers")});
  schema["allOf"] = Json::array({without_plugins(known.graph)});
  schema["definitions"] = std::move(definitions);
  Json whole{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "A graph of Jarol"}};
  whole.update(schema);
  return whole.dump(2) + "\n";
}

}  // namespace jarol::tools
