// Task types, distributers, policies and grammars from shared libraries, and on their way what layers above keep.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "graph/language/load.h"
#include "graph/plugins/parts.h"

namespace jarol {

/// Adds what a library names by JAROL_PLUGIN to what is known already. Returns what is wrong, or nothing; if something,
/// then nothing was added. `is_there`: do the layers above have one of that kind and name? The library stays loaded.
using IsThere = std::function<bool(const Extension& extension)>;
std::string load_plugin(const std::string& path, PluginParts& known, const IsThere& is_there);

/// The same of what the registry holds alone.
std::string load_plugin(const std::string& path, Registry& registry);

/// Has any library been loaded, whatever came of it?
bool are_plugins_loaded();

/// Where a plugin stands that a graph names: paths are relative to its file.
std::string plugin_path(const Location& graph, const std::string& plugin);

/// A plugin that a graph names, with the task types that it brought.
struct LoadedPlugin {
  std::string path;
  std::vector<std::string> types;
};

/// Adds what all plugins that a graph names bring, and reports what is wrong.
std::vector<LoadedPlugin> load_plugins(const GraphText& graph, PluginParts& known, const IsThere& is_there,
                                       Problems& problems);

/// What a library with tasks exports.
struct PluginLibrary {
  void (*add)(PluginParts& parts) = nullptr;
};

/// Loads it and looks how it computes; returns what is wrong, as words that follow its name. Runs its static
/// constructors, which may do anything.
std::string open_plugin(const std::string& path, PluginLibrary& library);

}  // namespace jarol
