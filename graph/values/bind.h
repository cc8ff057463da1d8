// From YAML to a value and from a value to text, led by the value's description.
#pragma once

#include <string>

#include "graph/language/yaml.h"
#include "graph/values/type.h"

namespace jarol {

/// Overwrites what `yaml` mentions in the value of type `type`; all that does not fit is reported, `subject` first.
void bind_value(const Yaml& yaml, const Type& type, const std::string& unit, void* value, const std::string& subject,
                Problems& problems);

/// The same for a mapping whose keys are fields of a struct that messages call `noun`: "parameter", "output".
void bind_fields(const Yaml& yaml, const Type& type, void* value, const std::string& subject, const std::string& noun,
                 Problems& problems);

/// A leaf as text: of a number the shortest form that reads back exactly, of a string JSON's form, of a sequence its
/// elements in brackets.
std::string scalar_text(const Type& type, const void* value);

/// "from -0.6 to 0.6".
std::string range_text(const Type& type, const FieldRange& range);

/// A single number, duration, truth value or enumerator from text; returns what is wrong, or nothing.
std::string parse_scalar(const Type& type, const std::string& text, const std::string& unit, void* value);

/// The scalars, strings and sequences of a type, depth first: "" for a plain number, "a.b" for members, "a.0" for
/// elements of arrays.
struct Leaf {
  std::string path;
  std::string unit;
  std::size_t offset = 0;
  const Type* type = nullptr;
};
std::vector<Leaf> leaves_of(const Type& type);

}  // namespace jarol
