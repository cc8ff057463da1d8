#include "runtime/record/ros2msg.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

#include "graph/text/escape.h"

namespace jarol {
namespace {

std::string number_name(const Type& type) {
  switch (type.kind) {
    case Kind::boolean: return "bool";
    case Kind::floating: return type.size == 4 ? "float32" : "float64";
    case Kind::unsigned_integer: return "uint" + std::to_string(8 * type.size);
    case Kind::signed_integer:
    case Kind::enumeration:
    case Kind::duration: return "int" + std::to_string(8 * type.size);
    default: return "";
  }
}

// Letters, digits and underscores, with a letter first.
std::string identifier(const std::string& name) {
  std::string made;
  for (const char c : name) made += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  if (made.empty() || std::isalpha(static_cast<unsigned char>(made[0])) == 0) made = "T" + made;
  return made;
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

class Definitions {
 public:
  std::string text_of(const Type& type) {
    std::string text = fields_of(type);
    // the definitions of structs ask for more of them
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      const auto [of, name] = wanted_[i];
      text += std::string(80, '=') + "\nMSG: jarol/" + name + "\n" + fields_of(*of);
    }
    return text;
  }

 private:
  std::string fields_of(const Type& type) {
    std::string text;
    if (type.kind != Kind::structure) {
      const bool listed = type.kind == Kind::array || type.kind == Kind::sequence;
      return "# the value itself\n" + field(type, listed ? "values" : "value", "", "");
    }
    // what a struct without members is in ROS
    if (type.fields.empty()) return "uint8 structure_needs_at_least_one_member\n";
    for (const TypeField& f : type.fields) text += field(*f.type, f.name, f.unit, f.text);
    return text;
  }

  std::string field(const Type& type, const std::string& name, const std::string& unit, const std::string& meaning) {
    std::string text;
    const Type* const one = type.kind == Kind::array || type.kind == Kind::sequence ? type.element : &type;
    if (one->kind == Kind::enumeration)
      for (const auto& [enumerator, number] : one->enumerators)
        text += number_name(*one) + " " + upper(name + "_" + enumerator) + "=" + std::to_string(number) + "\n";
    text += type_name_of(type) + " " + name;
    if (!unit.empty() || !meaning.empty())
      text +=
          " #" + (unit.empty() ? "" : " [" + printable(unit) + "]") + (meaning.empty() ? "" : " " + printable(meaning));
    return text + "\n";
  }

  std::string type_name_of(const Type& type) {
    switch (type.kind) {
      case Kind::string: return "uint8[]";
      case Kind::structure: return "jarol/" + name_of(type);
      case Kind::array: return element_name_of(*type.element) + "[" + std::to_string(type.count) + "]";
      case Kind::sequence: return element_name_of(*type.element) + "[]";
      default: return number_name(type);
    }
  }

  // there are no arrays of arrays
  std::string element_name_of(const Type& type) {
    const bool listed = type.kind == Kind::array || type.kind == Kind::sequence || type.kind == Kind::string;
    return listed ? "jarol/" + name_of(type) : type_name_of(type);
  }

  // A name of its own for each type that has a definition, as plugins may bring two of one name.
  std::string name_of(const Type& type) {
    for (const auto& [of, name] : wanted_)
      if (of == &type) return name;
    std::string name = identifier(type.name);
    const std::string plain = name;
    const auto is_taken = [&] {
      return std::any_of(wanted_.begin(), wanted_.end(), [&](const auto& w) { return w.second == name; });
    };
    for (int i = 2; is_taken(); ++i) name = plain + "_" + std::to_string(i);
    wanted_.emplace_back(&type, name);
    return name;
  }

  std::vector<std::pair<const Type*, std::string>> wanted_;
};

}  // namespace

MessageSchema schema_of(const Type& type) {
  return {"jarol/msg/" + identifier(type.name), Definitions().text_of(type)};
}

}  // namespace jarol
