#include "tools/report/value_json.h"

#include <nlohmann/json.hpp>

#include "graph/language/quantities.h"
#include "graph/values/bind.h"

namespace jarol::tools {

nlohmann::ordered_json to_json(const Type& type, const void* value) {
  const auto* bytes = static_cast<const std::byte*>(value);
  switch (type.kind) {
    case Kind::boolean: return read_integer(type, value) != 0;
    case Kind::signed_integer:
    case Kind::duration: return read_integer(type, value);
    case Kind::unsigned_integer: return static_cast<std::uint64_t>(read_integer(type, value));
    case Kind::floating: return read_floating(type, value);
    case Kind::enumeration: return scalar_text(type, value);
    case Kind::array: {
      auto list = nlohmann::ordered_json::array();
      for (std::size_t i = 0; i < type.count; ++i)
        list.push_back(to_json(*type.element, bytes + i * type.element->size));
      return list;
    }
    case Kind::string: return std::string(read_string(type, value));
    case Kind::sequence: {
      auto list = nlohmann::ordered_json::array();
      const auto* elements = static_cast<const std::byte*>(type.elements(value));
      for (std::size_t i = 0; i < type.length(value); ++i)
        list.push_back(to_json(*type.element, elements + i * type.element->size));
      return list;
    }
    case Kind::structure: {
      auto object = nlohmann::ordered_json::object();
      for (const TypeField& f : type.fields) object[f.name] = to_json(*f.type, bytes + f.offset);
      return object;
    }
  }
  return nullptr;
}

nlohmann::ordered_json outputs_to_json(const Graph& graph, const std::function<const void*(std::size_t)>& last_value) {
  auto outputs = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < graph.communicators.size(); ++i)
    if (graph.communicators[i].direction == Direction::out)
      outputs[graph.communicators[i].name] = to_json(*graph.communicators[i].type, last_value(i));
  return outputs;
}

std::string graph_text(const Type& type, const void* value) {
  if (type.kind == Kind::duration) return duration_text(Duration(read_integer(type, value)));
  using Json = nlohmann::ordered_json;
  const Json json = to_json(type, value);
  return json.is_string() ? json.get<std::string>() : json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace jarol::tools
