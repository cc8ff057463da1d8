#include "tools/commands/edit/catalogue.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "distributers/distributers.h"
#include "graph/language/tables.h"
#include "graph/values/value.h"
#include "tools/report/members.h"
#include "tools/report/value_json.h"

namespace jarol::tools::edit {
namespace {

using Json = nlohmann::ordered_json;

const char* kind_of(const Type& type) {
  switch (type.kind) {
    case Kind::boolean: return "bool";
    case Kind::enumeration: return "enum";
    case Kind::signed_integer:
    case Kind::unsigned_integer: return "integer";
    case Kind::floating: return "number";
    case Kind::duration: return "duration";
    case Kind::string: return "text";
    case Kind::array:
    case Kind::structure:
    case Kind::sequence: return "list";
  }
  return "";
}

Json member_json(const Member& member, const Value& defaults) {
  const TypeField& field = *member.field;
  const auto* value = static_cast<const std::byte*>(defaults.data()) + member.offset;
  Json json{{"path", member.path}, {"kind", kind_of(*field.type)}, {"default", graph_text(*field.type, value)}};
  if (!field.unit.empty()) json["unit"] = field.unit;
  if (!field.text.empty()) json["text"] = field.text;
  if (field.range.is_stated() && field.type->kind != Kind::duration) {
    json["min"] = field.range.min;
    if (std::isfinite(field.range.max)) json["max"] = field.range.max;
  }
  for (std::size_t i = 0; i < field.type->enumerators.size(); ++i) {
    json["words"].push_back({{"name", field.type->enumerators[i].first}});
    if (i < field.type->meanings.size() && !field.type->meanings[i].empty())
      json["words"].back()["meaning"] = field.type->meanings[i];
  }
  return json;
}

// Each member by its path; lists are edited as a whole.
Json fields_json(const Type* type) {
  auto fields = Json::array();
  if (type == nullptr) return fields;
  const Value defaults(*type);
  for (const Member& member : members_of(*type, Arrays::whole))
    if (!member.has_members) fields.push_back(member_json(member, defaults));
  return fields;
}

Json ports_json(const Type& type) {
  auto ports = Json::array();
  for (const TypeField& field : type.fields)
    ports.push_back({{"name", field.name}, {"type", field.type->name}, {"text", field.text}});
  return ports;
}

const char* word_of(Form form) {
  switch (form) {
    case Form::word: return "word";
    case Form::address:
    case Form::addresses: return "address";
    case Form::duration:
    case Form::positive_duration: return "duration";
    case Form::integer: return "integer";
    case Form::id: return "id";
    case Form::bytes: return "size";
    case Form::frequency: return "frequency";
    case Form::share: return "share";
    case Form::fault_limit: return "limit";
    case Form::choice: return "choice";
    case Form::mapping: return "mapping";
    case Form::any: return "value";
    case Form::section: return "section";
  }
  return "";
}

Json key_json(const KeyDescription& key) {
  Json json{{"name", key.name}, {"form", word_of(key.form)}, {"text", key.text}};
  if (key.required) json["required"] = true;
  if (!key.choices.empty()) json["choices"] = key.choices;
  for (const std::int64_t integer : key.integers) json["choices"].push_back(std::to_string(integer));
  return json;
}

template <class K>
Json keys_json(const std::vector<K>& keys) {
  auto list = Json::array();
  for (const KeyDescription& key : keys) list.push_back(key_json(key));
  return list;
}

Json tasks_json(const Registry& known) {
  auto tasks = Json::array();
  for (const TaskClass& task : known.tasks())
    tasks.push_back({{"name", task.name},
                     {"summary", task.summary},
                     {"parameters", fields_json(task.parameters)},
                     {"inputs", ports_json(*task.in)},
                     {"outputs", ports_json(*task.out)}});
  return tasks;
}

Json distributers_json(const distributers::Registries& known) {
  auto distributers = Json::array();
  for (const DistributerClass& distributer : known.graph.distributers()) {
    auto channels = Json::array();
    for (const ChannelClass& channel : distributer.channels)
      channels.push_back({{"name", channel.name},
                          {"direction", channel.direction == Direction::in ? "in" : "out"},
                          {"type", channel.type->name},
                          {"text", channel.text}});
    distributers.push_back({{"name", distributer.name},
                            {"summary", distributer.summary},
                            {"channels", std::move(channels)},
                            {"parameters", fields_json(distributer.parameters)},
                            {"links", links_of(distributer, known.links)}});
  }
  return distributers;
}

}  // namespace

Json catalogue_of(const distributers::Registries& known) {
  auto links = Json::array();
  for (const distributers::LinkType& link : known.links.entries())
    links.push_back({{"name", link.name}, {"summary", link.summary}, {"keys", keys_json(link.keys)}});
  return {{"tasks", tasks_json(known.graph)},
          {"distributers", distributers_json(known)},
          {"links", std::move(links)},
          {"types", known.graph.type_names()},
          {"keys",
           {{"timing", keys_json(timing_keys(names_of(known.graph.grammars())))},
            {"platform", keys_json(platform_keys(names_of(known.graph.policies())))},
            {"distributers", keys_json(distributer_keys())},
            {"communicators", keys_json(communicator_keys())},
            {"tasks", keys_json(task_keys())}}}};
}

}  // namespace jarol::tools::edit
