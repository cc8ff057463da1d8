// Task types from shared libraries.
#pragma once

#include <string>

#include "graph/registry.h"

namespace jarol {

/// Adds the tasks of a library that uses JAROL_PLUGIN. Returns what is wrong, or nothing; then nothing was added.
/// The library stays loaded.
std::string load_plugin(const std::string& path, Registry& registry);

/// Where a plugin stands that a graph names: paths are relative to its file.
std::string plugin_path(const GraphSpec& spec, const std::string& plugin);

/// Adds the tasks of all plugins that a graph names, and reports what is wrong.
void load_plugins(const GraphSpec& spec, Registry& registry, Problems& problems);

/// What a library with tasks exports.
struct PluginLibrary {
  void (*add)(Registry& registry) = nullptr;
};

/// Loads it and looks how it computes; returns what is wrong, as words that follow its name. Runs its static
/// constructors, which may do anything.
std::string open_plugin(const std::string& path, PluginLibrary& library);

}  // namespace jarol
