#include "tools/report/graph_schema.h"

#include <nlohmann/json.hpp>

#include "graph/language/tables.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;

const std::string name_pattern = "^[A-Za-z_][A-Za-z0-9_]*$";
const std::string duration_pattern = "^(0|[1-9][0-9]*)(\\.[0-9]+)? *(h|min|s|ms|us|ns)$";
const std::string bytes_pattern = "^(0|[1-9][0-9]*)(\\.[0-9]+)? *(B|KiB|MiB|GiB)$";
const std::string arrow_pattern =
    "^ *[A-Za-z_][A-Za-z0-9_]*(\\.[A-Za-z_][A-Za-z0-9_]*)? *-> *[A-Za-z_][A-Za-z0-9_]*(\\.[A-Za-z_][A-Za-z0-9_]*)? *$";

template <class S>
Json value_schema(const Key<S>& key) {
  switch (key.form) {
    case Form::word: return {{"type", "string"}};
    case Form::address:
    case Form::addresses: return {{"type", {"string", "integer"}}};
    case Form::duration:
    case Form::positive_duration: return {{"type", "string"}, {"pattern", duration_pattern}};
    case Form::integer: return {{"type", "integer"}, {"minimum", key.least}, {"maximum", key.most}};
    case Form::id: return {{"type", "integer"}, {"minimum", 0}};
    case Form::bytes: return {{"type", "string"}, {"pattern", bytes_pattern}};
    case Form::frequency:
    case Form::share: return {{"type", {"string", "number"}}};
    case Form::choice: return {{"enum", key.choices}};
    case Form::mapping: return {{"type", "object"}};
    case Form::any:
    case Form::section: return Json::object();
  }
  return Json::object();
}

template <class S>
Json mapping_schema(const std::vector<Key<S>>& keys) {
  Json properties = Json::object(), required = Json::array();
  for (const Key<S>& key : keys) {
    Json value = value_schema(key);
    value["description"] = key.text;
    properties[key.name] = std::move(value);
    if (key.required) required.push_back(key.name);
  }
  Json schema{{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = std::move(required);
  return schema;
}

// A section of named entries.
Json entries_schema(Json entry) {
  return {
      {"type", "object"}, {"patternProperties", {{name_pattern, std::move(entry)}}}, {"additionalProperties", false}};
}

void describe_section(Json& schema, const std::string& name, Json section) {
  section["description"] = schema["properties"][name]["description"];
  schema["properties"][name] = std::move(section);
}

}  // namespace

std::string graph_schema() {
  Json schema = mapping_schema(graph_keys());
  describe_section(schema, "timing", mapping_schema(timing_keys()));
  describe_section(schema, "plugins", {{"type", "array"}, {"items", {{"type", "string"}}}});
  describe_section(schema, "distributers", entries_schema(mapping_schema(distributer_keys())));
  describe_section(schema, "communicators", entries_schema(mapping_schema(communicator_keys())));
  describe_section(schema, "tasks", entries_schema(mapping_schema(task_keys())));
  describe_section(schema, "connections",
                   {{"type", "array"}, {"items", {{"type", "string"}, {"pattern", arrow_pattern}}}});
  describe_section(schema, "chains", entries_schema(mapping_schema(chain_keys())));
  describe_section(schema, "platform", mapping_schema(platform_keys()));
  describe_section(schema, "at_end", mapping_schema(at_end_keys()));
  describe_section(schema, "expect", {{"type", "array"}, {"items", {{"type", "string"}}}});
  describe_section(schema, "profiles", {{"type", "object"}, {"additionalProperties", {{"type", "object"}}}});
  Json whole{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "A graph of Jarol"}};
  whole.update(schema);
  return whole.dump(2) + "\n";
}

}  // namespace jarol::tools
