#include "tools/report/link_schema.h"

#include <nlohmann/json.hpp>

#include "distributers/distributers.h"
#include "distributers/interfaces/any_distributer.h"
#include "distributers/links/udp.h"
#include "graph/language/tables.h"
#include "tools/report/key_schema.h"
#include "tools/report/value_schema.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;
using distributers::LinkType;

// An address in brackets is IPv6, one of digits alone or without a host IPv4.
const char* const six = "^\\[";
const char* const four = "^([0-9.]+:)?[0-9]+$";

Json not_both(const std::string& one, const std::string& other) {
  return {{"not",
           {{"required", {one, other}},
            {"properties",
             {{one, {{"type", "string"}, {"pattern", six}}},
              {other, {{"anyOf", {{{"type", "integer"}}, {{"type", "string"}, {"pattern", four}}}}}}}}}}};
}

Json link_schema(const LinkType& type) {
  Json schema = mapping_schema(type.keys);
  schema["description"] = type.summary;
  schema["properties"]["type"] = {{"const", type.name}, {"description", type.summary}};
  if (!type.needs_one_of.empty()) {
    Json any = Json::array();
    for (const std::string& key : type.needs_one_of) any.push_back({{"required", {key}}});
    schema["anyOf"] = std::move(any);
  }
  std::vector<std::string> ends;
  for (const KeyDescription& key : type.keys)
    if (key.form == Form::address) ends.push_back(key.name);
  Json all = Json::array();
  if (ends.size() == 2) all = {not_both(ends[0], ends[1]), not_both(ends[1], ends[0])};
  for (const auto& [one, other] : type.not_together) all.push_back({{"not", {{"required", {one, other}}}}});
  if (!all.empty()) schema["allOf"] = std::move(all);
  return schema;
}

// What a distributer's message set has no room for in the header of its packets.
void limit_ids(const DistributerClass& distributer, Json& link) {
  if (distributer.make == nullptr) return;
  const Value parameters = distributer.parameters == nullptr ? Value() : Value(*distributer.parameters);
  const messages::MessageSet& set = distributer.make(parameters.data())->message_set();
  Json allowed = false;
  for (const messages::FieldDescriptor& field : set.header->fields)
    if (field.name == "src" && field.wire <= messages::Wire::uint32)
      allowed = {{"maximum", (std::int64_t{1} << (8 * size_of(field.wire))) - 1}};
  for (const char* key : {"id", "source"}) link["properties"][key] = allowed;
}

Json when(const std::string& key, const std::string& value, Json then) {
  return {{"if", {{"properties", {{key, {{"const", value}}}}}, {"required", {key}}}}, {"then", std::move(then)}};
}

Json rules_of(const DistributerClass& distributer, const distributers::Registries& known) {
  Json link{{"properties", {{"type", {{"enum", links_of(distributer, known.links)}}}}}};
  limit_ids(distributer, link);
  if (!distributers::why_one_peer(distributer).empty()) link["properties"]["peers"] = false;
  Json properties{{"link", std::move(link)}};
  properties["parameters"] = distributer.parameters == nullptr ? Json(false) : fields_schema(*distributer.parameters);
  return {{"properties", std::move(properties)}};
}

}  // namespace

Json link_schemas(const distributers::Registries& known) {
  Json all = Json::object();
  for (const LinkType& type : known.links.entries()) all["link." + type.name] = link_schema(type);
  return all;
}

Json distributer_schema(const distributers::Registries& known) {
  Json schema = mapping_schema(distributer_keys());
  Json types = Json::array(), rules = Json::array(), links = Json::array();
  for (const DistributerClass& distributer : known.graph.distributers()) {
    types.push_back({{"const", distributer.name}, {"description", distributer.summary}});
    rules.push_back(when("type", distributer.name, rules_of(distributer, known)));
  }
  for (const LinkType& type : known.links.entries())
    links.push_back(when("type", type.name, {{"$ref", "#/definitions/link." + type.name}}));
  Json& link = schema["properties"]["link"];
  link["required"] = Json::array({"type"});
  link["properties"]["type"] = {{"enum", known.links.names()}};
  link["allOf"] = std::move(links);
  schema["properties"]["type"]["oneOf"] = std::move(types);
  schema["allOf"] = std::move(rules);
  return schema;
}

}  // namespace jarol::tools
