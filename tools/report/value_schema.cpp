#include "tools/report/value_schema.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "graph/language/quantities.h"
#include "graph/language/units.h"
#include "graph/values/bind.h"
#include "graph/values/value.h"
#include "tools/report/value_json.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;

const std::string whole = "(0|[1-9][0-9]*)(\\.[0-9]+)?";
const std::string not_zero = "(?=[0.]*[1-9])";
const std::string durations = " *(h|min|s|ms|us|ns)$";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += (c == '/' || c == '.' || c == '^' || c == '*' ? std::string("\\") : "") + c;
  return result;
}

// A number of its own has YAML's form, whatever its unit; one that says its unit is a word.
Json number_schema(double max, const std::string& unit, const FieldRange& range) {
  Json number{{"type", "number"},
              {"minimum", range.is_stated() ? range.min : -max},
              {"maximum", range.is_stated() ? range.max : max}};
  if (unit.empty()) return number;
  return {{"anyOf", {std::move(number), {{"type", "string"}, {"pattern", number_pattern(unit)}}}}};
}

Json integer_schema(const Type& type, const FieldRange& range) {
  const std::size_t bits = 8 * type.size;
  const bool is_signed = type.kind == Kind::signed_integer;
  Json schema{{"type", "integer"}, {"minimum", 0}};
  if (is_signed)
    schema["minimum"] = bits == 64 ? std::numeric_limits<std::int64_t>::min() : -(std::int64_t{1} << (bits - 1));
  const std::size_t places = bits - (is_signed ? 1 : 0);
  schema["maximum"] = places >= 63 ? std::numeric_limits<std::int64_t>::max() : (std::int64_t{1} << places) - 1;
  if (range.is_stated()) {
    schema["minimum"] = static_cast<std::int64_t>(range.min);
    schema["maximum"] = static_cast<std::int64_t>(range.max);
  }
  return schema;
}

Json enumeration_schema(const Type& type) {
  Json schema{{"enum", Json::array()}};
  std::string meanings;
  for (std::size_t i = 0; i < type.enumerators.size(); ++i) {
    const std::string& name = type.enumerators[i].first;
    schema["enum"].push_back(name);
    if (i < type.meanings.size() && !type.meanings[i].empty())
      meanings += (meanings.empty() ? "" : "; ") + name + ": " + type.meanings[i];
  }
  if (!meanings.empty()) schema["description"] = meanings;
  return schema;
}

// As it would be written.
Json default_of(const Type& type, const void* value) {
  return type.kind == Kind::duration ? Json(duration_text(Duration(read_integer(type, value)))) : to_json(type, value);
}

std::string described(const TypeField& field) {
  std::string text = field.text;
  if (!field.unit.empty()) text += (text.empty() ? "[" : " [") + field.unit + "]";
  if (field.range.is_stated()) text += (text.empty() ? "" : ", ") + range_text(*field.type, field.range);
  return text;
}

}  // namespace

const std::string duration_pattern = "^" + whole + durations;
const std::string positive_duration_pattern = "^" + not_zero + whole + durations;
const std::string bytes_pattern = "^" + whole + " *(B|KiB|MiB|GiB)$";

std::string number_pattern(const std::string& unit) {
  std::string units;
  for (const std::string& each : units_for(unit)) units += (units.empty() ? "" : "|") + escaped(each);
  return "^-?" + whole + "([eE][-+]?[0-9]+)? *(" + units + ")$";
}

Json value_schema(const Type& type, const std::string& unit, const FieldRange& range) {
  switch (type.kind) {
    case Kind::boolean: return {{"type", "boolean"}};
    case Kind::signed_integer:
    case Kind::unsigned_integer: return integer_schema(type, range);
    case Kind::floating:
      return number_schema(
          type.size == 4 ? static_cast<double>(std::numeric_limits<float>::max()) : std::numeric_limits<double>::max(),
          unit, range);
    case Kind::duration: return {{"type", "string"}, {"pattern", duration_pattern}};
    case Kind::enumeration: return enumeration_schema(type);
    case Kind::string: return {{"type", {"string", "number", "boolean"}}};
    case Kind::array:
      return {{"type", "array"},
              {"items", value_schema(*type.element, unit, range)},
              {"minItems", type.count},
              {"maxItems", type.count}};
    case Kind::sequence: return {{"type", "array"}, {"items", value_schema(*type.element, unit, range)}};
    case Kind::structure: return fields_schema(type);
  }
  return Json::object();
}

Json fields_schema(const Type& type) {
  const Value value(type);
  Json properties = Json::object();
  for (const TypeField& field : type.fields) {
    Json schema = value_schema(*field.type, field.unit, field.range);
    if (const std::string text = described(field); !text.empty())
      schema["description"] =
          schema.contains("description") ? text + "; " + schema["description"].get<std::string>() : text;
    if (field.type->kind != Kind::structure)
      schema["default"] = default_of(*field.type, static_cast<const std::byte*>(value.data()) + field.offset);
    properties[field.name] = std::move(schema);
  }
  return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

}  // namespace jarol::tools
