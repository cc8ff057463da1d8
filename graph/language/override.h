// Overrides: one rule for profiles and for --set.
#pragma once

#include <string>

#include "graph/language/yaml.h"

namespace jarol {

/// Puts `value` at `path` ("tasks.depth.parameters.kp"); the place of the path is `where`. Keys on the way may be new
/// only below a task, communicator or distributer that exists.
void apply_override(Yaml& graph, const std::string& path, const Location& where, Yaml value, Problems& problems);

/// "path=value" as it came from the command line: the path, and the value with its places in the argument. Returns
/// false after a report; `option` is where it came from, `example` shows what would be right.
bool read_set(const std::string& argument, const std::string& option, std::string_view example, std::string& path,
              Yaml& value, Problems& problems);

/// Applies "path=value" as it came from the command line.
void apply_set(Yaml& graph, const std::string& argument, Problems& problems);

/// Applies the profile of that name from the graph's own `profiles:`.
void apply_profile(Yaml& graph, const std::string& profile, Problems& problems);

}  // namespace jarol
