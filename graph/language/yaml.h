// A strict tree of a YAML text: what parsers let pass silently is an error here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "graph/language/problems.h"

namespace jarol {

/// One value of a YAML text with its place; in a mapping also its key.
struct Yaml {
  enum class Kind { null, scalar, sequence, mapping };

  Kind kind = Kind::null;
  bool quoted = false;         // a scalar in quotes is a string, never a number
  std::string text;            // scalar
  std::vector<Yaml> children;  // sequence, mapping
  Location where;
  std::string key;  // of a child of a mapping
  Location key_where;

  /// The child of that key, or null.
  const Yaml* find(std::string_view name) const;
};

/// "a scalar", "a mapping" ... for messages.
std::string_view kind_name(const Yaml& yaml);

/// Reads the one document of a text. Errors of syntax, duplicate keys, `<<` merges, cyclic aliases, tags, and absurd
/// depth or size go to `problems`; what could be read is returned.
Yaml read_yaml(const std::shared_ptr<const Source>& source, Problems& problems);

/// The text of a file as a source named by its path; a file that can't be read throws SpecError.
std::shared_ptr<const Source> read_source(const std::string& path);

}  // namespace jarol
