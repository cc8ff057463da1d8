#include "tools/report/key_schema.h"

#include "tools/report/value_schema.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;

const std::string host = "([^][:,\\s]+:|\\[[0-9A-Fa-f:.]+\\]:)?";
const std::string address = host + "[0-9]{1,5}";
const std::string addresses = address + "(-[0-9]{1,5})?";
constexpr int max_port = 65535;

// One that is a number of its own, or one with a sign.
Json share_schema() {
  return {{"anyOf",
           {{{"type", "number"}, {"minimum", 0}, {"maximum", 1}},
            {{"type", "string"}, {"pattern", "^(100(\\.0+)?|[1-9]?[0-9](\\.[0-9]+)?)%$"}}}}};
}

Json frequency_schema() {
  return {{"anyOf",
           {{{"type", "number"}, {"exclusiveMinimum", 0}},
            {{"type", "string"}, {"pattern", "^(?=[0.]*[1-9])" + number_pattern("rad/s").substr(3)}}}}};
}

Json integer_schema(const KeyDescription& key) {
  if (!key.integers.empty()) return {{"enum", key.integers}};
  const bool limited = key.limits.first <= key.limits.second;
  return {{"type", "integer"},
          {"minimum", limited ? key.limits.first : key.min},
          {"maximum", limited ? key.limits.second : key.max}};
}

Json port_or(const std::string& pattern) {
  return {{"anyOf",
           {{{"type", "integer"}, {"minimum", 0}, {"maximum", max_port}},
            {{"type", "string"}, {"pattern", "^" + pattern + "$"}}}}};
}

Json schema_of(const KeyDescription& key) {
  switch (key.form) {
    case Form::word: return {{"type", "string"}, {"minLength", 1}};
    case Form::address: return port_or(address);
    case Form::addresses: return port_or(" *" + addresses + "( *, *" + addresses + ")* *");
    case Form::duration: return {{"type", "string"}, {"pattern", duration_pattern}};
    case Form::positive_duration: return {{"type", "string"}, {"pattern", positive_duration_pattern}};
    case Form::integer: return integer_schema(key);
    case Form::id: return {{"type", "integer"}, {"minimum", 0}};
    case Form::bytes: return {{"type", "string"}, {"pattern", bytes_pattern}};
    case Form::frequency: return frequency_schema();
    case Form::share: return share_schema();
    case Form::fault_limit: return {{"type", "string"}, {"pattern", "^[1-9][0-9]* of [1-9][0-9]*$"}};
    case Form::choice: return {{"enum", key.choices}};
    case Form::mapping: return key.keys.empty() ? Json{{"type", "object"}} : mapping_schema(key.keys);
    case Form::any:
    case Form::section: return Json::object();
  }
  return Json::object();
}

}  // namespace

const std::string name_pattern = "^[A-Za-z_][A-Za-z0-9_]*$";

Json key_schema(const KeyDescription& key) {
  Json schema = schema_of(key);
  schema["description"] = key.text;
  return schema;
}

Json mapping_schema(const std::vector<KeyDescription>& keys) {
  Json properties = Json::object(), required = Json::array();
  for (const KeyDescription& key : keys) {
    properties[key.name] = key_schema(key);
    if (key.required) required.push_back(key.name);
  }
  Json schema{{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = std::move(required);
  return schema;
}

}  // namespace jarol::tools
