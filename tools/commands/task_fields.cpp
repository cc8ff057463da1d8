#include "tools/commands/task_fields.h"

#include <algorithm>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "graph/language/quantities.h"
#include "graph/values/bind.h"
#include "graph/values/value.h"
#include "tools/report/members.h"

namespace jarol::tools {
namespace {

std::string list_text(const Type& element, const void* elements, std::size_t count);

// As a graph says it.
std::string default_text(const Type& type, const void* value) {
  const auto* bytes = static_cast<const std::byte*>(value);
  switch (type.kind) {
    case Kind::duration: return duration_text(Duration(read_integer(type, value)));
    case Kind::array: return list_text(*type.element, value, type.count);
    case Kind::sequence: return list_text(*type.element, type.elements(value), type.length(value));
    case Kind::structure: {
      std::string text;
      for (const TypeField& f : type.fields)
        text += (text.empty() ? "" : ", ") + f.name + ": " + default_text(*f.type, bytes + f.offset);
      return "{" + text + "}";
    }
    case Kind::boolean:
    case Kind::signed_integer:
    case Kind::unsigned_integer:
    case Kind::floating:
    case Kind::enumeration:
    case Kind::string: break;
  }
  return scalar_text(type, value);
}

std::string list_text(const Type& element, const void* elements, std::size_t count) {
  const auto* bytes = static_cast<const std::byte*>(elements);
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
    text += (i == 0 ? "" : ", ") + default_text(element, bytes + i * element.size);
  return "[" + text + "]";
}

std::string default_text(const Member& member, const Value& defaults) {
  return default_text(*member.field->type, static_cast<const std::byte*>(defaults.data()) + member.offset);
}

// Of the numbers or words in arrays and sequences, that of one.
const Type& innermost(const Type& type) { return type.element != nullptr ? innermost(*type.element) : type; }

std::string padded(const std::string& text, std::size_t width) { return text + std::string(width - text.size(), ' '); }

// The words of an enumeration below what has its type: with meanings one a line, else all in one.
void print_enumerators(const Type& type, const std::string& margin) {
  if (type.enumerators.empty()) return;
  std::size_t width = 0;
  std::string names;
  bool explained = false;
  for (std::size_t i = 0; i < type.enumerators.size(); ++i) {
    const std::string& name = type.enumerators[i].first;
    width = std::max(width, name.size());
    names += (i == 0 ? "" : ", ") + name;
    explained = explained || !type.meanings[i].empty();
  }
  if (!explained) {
    std::cout << margin << names << "\n";
    return;
  }
  for (std::size_t i = 0; i < type.enumerators.size(); ++i) {
    const std::string& name = type.enumerators[i].first;
    std::cout << margin << (type.meanings[i].empty() ? name : padded(name, width + 2) + type.meanings[i]) << "\n";
  }
}

std::string type_text(const TypeField& field) {
  return field.type->name + (field.unit.empty() ? "" : " [" + field.unit + "]") +
         (field.range.is_stated() ? " " + range_text(*field.type, field.range) : "");
}

struct Columns {
  std::size_t name = 0, type = 0;
};

Columns columns_of(std::span<const Member> members) {
  Columns columns;
  for (const Member& m : members) {
    columns.name = std::max(columns.name, m.path.size());
    columns.type = std::max(columns.type, type_text(*m.field).size());
  }
  return columns;
}

// Structs have no default of their own: their members do.
void print_member(const Member& member, const Columns& columns, const std::string& margin, const Value* defaults) {
  const TypeField& field = *member.field;
  std::string line =
      margin + padded(member.path, columns.name + 2) + padded(type_text(field), columns.type + 2) + field.text;
  if (defaults != nullptr && !member.has_members)
    line += (field.text.empty() ? "" : ", ") + std::string("default ") + default_text(member, *defaults);
  line.erase(line.find_last_not_of(' ') + 1);
  std::cout << line << "\n";
  print_enumerators(innermost(*field.type), margin + "  ");
}

nlohmann::ordered_json bound_json(const Type& type, double bound) {
  if (type.kind == Kind::duration) return duration_text(Duration(static_cast<std::int64_t>(bound)));
  return bound;
}

nlohmann::ordered_json member_json(const Member& member, const Value& defaults) {
  const TypeField& field = *member.field;
  nlohmann::ordered_json json{{"name", member.path},
                              {"type", field.type->name},
                              {"unit", field.unit},
                              {"text", field.text},
                              {"default", default_text(member, defaults)}};
  const Type& type = innermost(*field.type);
  if (field.range.is_stated())
    json.update({{"minimum", bound_json(type, field.range.min)}, {"maximum", bound_json(type, field.range.max)}});
  for (std::size_t i = 0; i < type.enumerators.size(); ++i)
    json["enumerators"].push_back({{"name", type.enumerators[i].first}, {"meaning", type.meanings[i]}});
  return json;
}

// Is it a field of the outermost struct?
bool is_outermost(const Member& member) { return member.path == member.field->name; }

}  // namespace

void print_fields(const std::string& title, const Type& type, bool with_defaults) {
  if (type.fields.empty()) return;
  std::cout << "\n" << title << "\n";
  const Value value(type);
  const Value* defaults = with_defaults ? &value : nullptr;
  const std::vector<Member> all = members_of(type, Arrays::by_element);
  std::vector<Member> outermost;
  std::copy_if(all.begin(), all.end(), std::back_inserter(outermost), is_outermost);
  const Columns columns = columns_of(outermost);
  for (auto member = all.begin(); member != all.end();) {
    print_member(*member, columns, "  ", defaults);
    const std::span<const Member> inner(member + 1, std::find_if(member + 1, all.end(), is_outermost));
    const Columns inner_columns = columns_of(inner);
    for (const Member& each : inner) print_member(each, inner_columns, "    ", defaults);
    member += 1 + static_cast<std::ptrdiff_t>(inner.size());
  }
}

nlohmann::ordered_json fields_json(const Type& type) {
  auto list = nlohmann::ordered_json::array();
  const Value defaults(type);
  for (const Member& member : members_of(type, Arrays::by_element)) {
    if (is_outermost(member)) {
      list.push_back(member_json(member, defaults));
    } else {
      list.back()["members"].push_back(member_json(member, defaults));
    }
  }
  return list;
}

}  // namespace jarol::tools
