// A graph as every command that takes one loads it: with all that is built in, and what is noted goes to stderr.
#pragma once

#include <string>

#include "distributers/session/load.h"

namespace jarol::tools {

/// The file as it stands, its plugins as allowed.
Overrides without_changes(const Overrides& overrides);

/// As jarol::load_graph; a plugin is noted once each.
Loaded load_graph(const std::string& path, const Overrides& overrides, std::uint64_t seed = 0);
Loaded load_graph(const std::shared_ptr<const Source>& source, const Overrides& overrides, std::uint64_t seed = 0);

/// The same without external systems: of the files that links name, none is needed. `recorded`: as of jarol's.
Loaded load_without_systems(const std::string& path, const Overrides& overrides,
                            const RecordingHeader* recorded = nullptr);

/// A line on stderr.
void print_note(const std::string& text);
/// The same, but each text once in a process. Any thread.
void note_once(const std::string& text);

}  // namespace jarol::tools
