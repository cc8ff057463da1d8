#include "tools/commands/run/load_graph.h"

#include <iostream>
#include <mutex>
#include <set>

#include "tools/library/built_in.h"

namespace jarol::tools {

void note_once(const std::string& text) {
  static std::mutex mutex;
  static std::set<std::string> noted;
  const std::lock_guard lock(mutex);
  if (noted.insert(text).second) print_note(text);
}

Overrides without_changes(const Overrides& overrides) { return {"", {}, overrides.no_plugins}; }

Loaded load_graph(const std::string& path, const Overrides& overrides, std::uint64_t seed) {
  return load_graph(read_source(path), overrides, seed);
}

Loaded load_graph(const std::shared_ptr<const Source>& source, const Overrides& overrides, std::uint64_t seed) {
  return jarol::load_graph(source, built_in(), overrides, seed, note_once);
}

Loaded load_without_systems(const std::string& path, const Overrides& overrides, const RecordingHeader* recorded) {
  return jarol::load_without_systems(read_source(path), built_in(), overrides, note_once, recorded);
}

void print_note(const std::string& text) { std::cerr << "note: " << text << "\n"; }

}  // namespace jarol::tools
