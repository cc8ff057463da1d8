// Task types from shared libraries.
#pragma once

#include <string>

#include "graph/registry.h"

namespace jarol {

/// Adds the tasks of a library that uses JAROL_PLUGIN. Returns what is wrong, or nothing; then nothing was added.
/// The library stays loaded.
std::string load_plugin(const std::string& path, Registry& registry);

/// Adds the tasks of all plugins that a graph names, their paths relative to its file, and reports what is wrong.
void load_plugins(const GraphSpec& spec, Registry& registry, Problems& problems);

}  // namespace jarol
