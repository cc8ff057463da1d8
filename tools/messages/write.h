// A definition as C++: a header with a described struct for each message, and a source with the tables of their forms.
#pragma once

#include <string>

#include "tools/messages/definition.h"

namespace jarol::definition {

/// `set` is the name of the set, its namespace and its files.
std::string write_header(const Definition& definition, const std::string& set);
std::string write_tables(const Definition& definition, const std::string& set);

/// The list of all sets, for `message_sets()`.
std::string write_catalogue(const std::vector<std::string>& sets);

/// C++ names of what the definition names: of each message's members, of values, of shared enumerations. What C++
/// keeps for itself, or what is taken, gets an underscore.
struct Names {
  explicit Names(const Definition& definition);
  std::map<std::string, std::string> structs;                            // by name of the message
  std::map<std::string, std::string> shared;                             // by name of the enumeration or bitfield
  std::map<std::string, std::map<std::string, std::string>> members;     // by names of message and field
  std::map<std::string, std::map<std::string, std::string>> own_values;  // the same: struct of a field's own values
};

/// C++ names for values of one enumeration.
std::vector<std::string> value_names(const std::vector<NamedValue>& values);

/// Can it be the name of a set, as of its file and namespace?
bool is_set_name(const std::string& name);

/// A C++ string literal.
std::string quoted(const std::string& text);

}  // namespace jarol::definition
