#include "graph/values/bind.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "graph/language/quantities.h"
#include "graph/text/article.h"

namespace jarol {
namespace {

std::byte* at(void* value, std::size_t offset) { return static_cast<std::byte*>(value) + offset; }

// What a message calls the type: "double [rad/m]", "double [rad] from -0.6 to 0.6".
std::string wanted(const Type& type, const std::string& unit, const FieldRange& range) {
  std::string text = type.name;
  if (type.kind == Kind::enumeration) {
    std::vector<std::string> names;
    for (const auto& [name, number] : type.enumerators) names.push_back(name);
    text = "one of " + list_of(names);
  }
  if (!unit.empty()) text += " [" + unit + "]";
  return range.is_stated() ? text + " " + range_text(type, range) : text;
}

std::string wanted_with_article(const Type& type, const std::string& unit, const FieldRange& range) {
  const std::string text = wanted(type, unit, range);
  return type.kind == Kind::enumeration ? text : with_article(text);
}

void bind_as(const Yaml& yaml, const Type& type, const std::string& unit, const FieldRange& range, void* value,
             const std::string& subject, Problems& problems);

void bind_structure(const Yaml& yaml, const Type& type, void* value, const std::string& subject,
                    const std::string& noun, Problems& problems) {
  std::vector<std::string> names;
  for (const TypeField& f : type.fields) names.push_back(f.name);
  for (const Yaml& child : yaml.children) {
    const TypeField* f = find_field(type, child.key);
    if (f == nullptr) {
      problems.add(child.key_where, subject + " has no " + noun + " '" + child.key + "'" +
                                        did_you_mean(child.key, names) + "; it has: " + list_of(names));
      continue;
    }
    bind_as(child, *f->type, f->unit, f->range, at(value, f->offset), subject + " " + noun + " '" + child.key + "'",
            problems);
  }
}

void bind_array(const Yaml& yaml, const Type& type, const std::string& unit, const FieldRange& range, void* value,
                const std::string& subject, Problems& problems) {
  if (yaml.children.size() != type.count) {
    problems.add(yaml.where, subject + " has " + std::to_string(yaml.children.size()) + " elements; it needs " +
                                 std::to_string(type.count));
    return;
  }
  for (std::size_t i = 0; i < type.count; ++i)
    bind_as(yaml.children[i], *type.element, unit, range, at(value, i * type.element->size),
            subject + " element " + std::to_string(i), problems);
}

void bind_sequence(const Yaml& yaml, const Type& type, const std::string& unit, const FieldRange& range, void* value,
                   const std::string& subject, Problems& problems) {
  void* const elements = type.resize(value, yaml.children.size());
  for (std::size_t i = 0; i < yaml.children.size(); ++i)
    bind_as(yaml.children[i], *type.element, unit, range, at(elements, i * type.element->size),
            subject + " element " + std::to_string(i), problems);
}

void bind_as(const Yaml& yaml, const Type& type, const std::string& unit, const FieldRange& range, void* value,
             const std::string& subject, Problems& problems) {
  const auto expected = type.kind == Kind::structure                              ? Yaml::Kind::mapping
                        : type.kind == Kind::array || type.kind == Kind::sequence ? Yaml::Kind::sequence
                                                                                  : Yaml::Kind::scalar;
  if (yaml.kind != expected) {
    const std::string need = expected == Yaml::Kind::mapping ? "a mapping of " + type.name + "'s fields"
                             : type.kind == Kind::sequence   ? "a list of elements of type " + type.element->name
                             : expected == Yaml::Kind::sequence
                                 ? "a list of " + std::to_string(type.count) + " elements"
                                 : wanted_with_article(type, unit, range);
    problems.add(yaml.where, subject + " needs " + need + ", not " + std::string(kind_name(yaml)));
    return;
  }
  if (type.kind == Kind::structure) return bind_structure(yaml, type, value, subject, "field", problems);
  if (type.kind == Kind::array) return bind_array(yaml, type, unit, range, value, subject, problems);
  if (type.kind == Kind::sequence) return bind_sequence(yaml, type, unit, range, value, subject, problems);
  const bool text = type.kind == Kind::enumeration || type.kind == Kind::string;
  std::string wrong =
      yaml.quoted && !text ? "is in quotes and so a string" : parse_scalar(type, yaml.text, unit, value);
  if (wrong.empty() && range.is_stated() && !range.has(read_ranged(type, value))) wrong = "is outside";
  if (wrong.empty()) return;
  problems.add(yaml.where, subject + " needs " + wanted_with_article(type, unit, range) + ", not '" + yaml.text +
                               "'; that " + wrong);
}

void add_leaves(const Type& type, const std::string& path, const std::string& unit, std::size_t offset,
                std::vector<Leaf>& leaves) {
  const std::string prefix = path.empty() ? "" : path + ".";
  if (type.kind == Kind::structure) {
    for (const TypeField& f : type.fields) add_leaves(*f.type, prefix + f.name, f.unit, offset + f.offset, leaves);
  } else if (type.kind == Kind::array) {
    for (std::size_t i = 0; i < type.count; ++i)
      add_leaves(*type.element, prefix + std::to_string(i), unit, offset + i * type.element->size, leaves);
  } else {
    leaves.push_back({path, unit, offset, &type});
  }
}

// JSON's form of a string.
std::string quoted_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) {
      quoted += c;
    } else {
      constexpr std::string_view digits = "0123456789abcdef";
      quoted += std::string("\\u00") + (c >= 0x10 ? '1' : '0') + digits[static_cast<std::size_t>(c & 15)];
    }
  }
  return quoted + "\"";
}

// An element of a sequence, whatever it is: "1", "{a:1,b.0:2}".
std::string compact_text(const Type& type, const void* value) {
  if (type.kind != Kind::structure && type.kind != Kind::array) return scalar_text(type, value);
  std::string text;
  for (const Leaf& leaf : leaves_of(type))
    text += (text.empty() ? "" : ",") + leaf.path + ":" +
            scalar_text(*leaf.type, static_cast<const std::byte*>(value) + leaf.offset);
  return "{" + text + "}";
}

std::int64_t min_of(const Type& type) {
  if (type.kind == Kind::unsigned_integer) return 0;
  return type.size == 8 ? std::numeric_limits<std::int64_t>::min() : -(std::int64_t{1} << (8 * type.size - 1));
}

std::int64_t max_of(const Type& type) {
  const std::size_t bits = 8 * type.size - (type.kind == Kind::unsigned_integer ? 0 : 1);
  return bits >= 63 ? std::numeric_limits<std::int64_t>::max() : (std::int64_t{1} << bits) - 1;
}

}  // namespace

void bind_value(const Yaml& yaml, const Type& type, const std::string& unit, void* value, const std::string& subject,
                Problems& problems) {
  bind_as(yaml, type, unit, {}, value, subject, problems);
}

void bind_fields(const Yaml& yaml, const Type& type, void* value, const std::string& subject, const std::string& noun,
                 Problems& problems) {
  if (yaml.kind != Yaml::Kind::mapping) {
    problems.add(yaml.where, subject + " needs a mapping of its " + noun + "s, not " + std::string(kind_name(yaml)));
    return;
  }
  bind_structure(yaml, type, value, subject, noun, problems);
}

std::string parse_scalar(const Type& type, const std::string& text, const std::string& unit, void* value) {
  switch (type.kind) {
    case Kind::boolean:
      if (text != "true" && text != "false") return "is neither true nor false";
      write_integer(type, value, text == "true");
      return "";
    case Kind::floating: {
      double number = 0;
      const std::string wrong = parse_number(text, unit, number);
      if (!wrong.empty()) return wrong;
      if (type.size == 4 && std::abs(number) > std::numeric_limits<float>::max()) return "is beyond what a float holds";
      write_floating(type, value, number);
      return "";
    }
    case Kind::duration: {
      Duration duration{};
      const std::string wrong = parse_duration(text, duration);
      if (wrong.empty()) write_integer(type, value, duration.count());
      return wrong;
    }
    case Kind::signed_integer:
    case Kind::unsigned_integer: {
      std::int64_t integer = 0;
      const std::string wrong = parse_integer(text, min_of(type), max_of(type), integer);
      if (wrong.empty()) write_integer(type, value, integer);
      return wrong;
    }
    case Kind::enumeration:
      for (const auto& [name, number] : type.enumerators) {
        if (name != text) continue;
        write_integer(type, value, number);
        return "";
      }
      return "is none of them";
    case Kind::string: write_string(type, value, text); return "";
    case Kind::array:
    case Kind::sequence:
    case Kind::structure: break;
  }
  return "is a single word";
}

std::string scalar_text(const Type& type, const void* value) {
  switch (type.kind) {
    case Kind::boolean: return read_integer(type, value) != 0 ? "true" : "false";
    case Kind::floating:
      return type.size == 4 ? number_text(static_cast<float>(read_floating(type, value)))
                            : number_text(read_floating(type, value));
    case Kind::unsigned_integer: return std::to_string(static_cast<std::uint64_t>(read_integer(type, value)));
    case Kind::duration:
    case Kind::signed_integer: return std::to_string(read_integer(type, value));
    case Kind::enumeration: {
      const std::int64_t number = read_integer(type, value);
      for (const auto& [name, its] : type.enumerators)
        if (its == number) return name;
      return std::to_string(number);
    }
    case Kind::string: return quoted_text(read_string(type, value));
    case Kind::sequence: {
      std::string text;
      const auto* elements = static_cast<const std::byte*>(type.elements(value));
      for (std::size_t i = 0; i < type.length(value); ++i)
        text += (i == 0 ? "" : ",") + compact_text(*type.element, elements + i * type.element->size);
      return "[" + text + "]";
    }
    case Kind::array:
    case Kind::structure: break;
  }
  return "";
}

std::string range_text(const Type& type, const FieldRange& range) {
  const Type* number = &type;
  while (number->element != nullptr) number = number->element;
  const auto text = [&](double end) {
    const auto nearest = static_cast<float>(end);
    if (number->kind == Kind::floating && number->size == sizeof nearest) return scalar_text(*number, &nearest);
    return number->kind == Kind::duration ? duration_text(Duration(static_cast<std::int64_t>(end))) : number_text(end);
  };
  return "from " + text(range.min) + " to " + text(range.max);
}

std::vector<Leaf> leaves_of(const Type& type) {
  std::vector<Leaf> leaves;
  add_leaves(type, "", "", 0, leaves);
  return leaves;
}

}  // namespace jarol
