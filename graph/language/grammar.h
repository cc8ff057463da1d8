// A timing grammar that graphs may name: further keys of the graph language, and what they mean in it.
#pragma once

#include <string_view>
#include <vector>

#include "graph/language/yaml.h"

namespace jarol {

/// A key that a grammar adds, for people and editors.
struct GrammarKey {
  std::string_view section;  // "tasks", "communicators", "timing"
  std::string_view name;
  std::string_view text;  // meaning and default
};

/// The texts are of the program or of a plugin, which stays loaded.
struct Grammar {
  std::string_view name;
  std::string_view how;  // a graph states times, as a clause
  std::vector<GrammarKey> keys{};
  /// Writes in the words of the language what a graph says in those that the grammar adds, and takes these away, after
  /// profiles and single overrides and before anything else looks at it. What it writes has the place of the words that
  /// it stands for; what is wrong goes to `problems`. Null: it is the language itself.
  void (*lower)(Yaml& graph, Problems& problems) = nullptr;

  /// Names are unique in a registry.
  bool operator==(const Grammar& other) const { return name == other.name; }
};

/// The name of the grammar that adds nothing, which every graph may state.
inline constexpr std::string_view language_itself = "let";

/// In the order in which they are listed.
const std::vector<Grammar>& built_in_grammars();

/// The place of a child of a mapping, or null.
Yaml* find_child(Yaml& mapping, std::string_view key);

/// A child of a mapping with the place of the words that it stands for; replaces one of that key.
void put_child(Yaml& mapping, std::string_view key, std::string_view text, const Yaml& stands_for);

/// Takes a child away; does nothing if there is none.
void take_child(Yaml& mapping, std::string_view key);

}  // namespace jarol
