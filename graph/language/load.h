// From the text of a graph to its specification.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "graph/language/grammar.h"
#include "graph/language/spec.h"

namespace jarol {

/// What a run changes of a file: a profile of its own, then single values in their order.
struct Overrides {
  std::string profile;           // empty: none
  std::vector<std::string> set;  // "path=value", as in "tasks.depth.parameters.kp=0.7"
  std::string no_plugins{};      // why plugins that it names are an error; empty: they are none
};

/// Letters, digits and _, no digit first: what tasks and the like may be called.
bool is_name(std::string_view text);

/// A graph with what a run changes of it, in the words of its timing grammar, which a plugin of its own may bring.
struct GraphText {
  Yaml tree;
  Location where;                             // of the whole
  std::vector<Located<std::string>> plugins;  // paths, relative to the graph's file
  bool readable = false;                      // else there is no more to read
};
GraphText read_text(const std::shared_ptr<const Source>& source, const Overrides& overrides, Problems& problems);

/// Reads a graph. All that is wrong goes to `problems`; what could be read is returned. Throws SpecError where the
/// grammar is none of these or can't read it, as nothing else can be said then; `all_known`: it is no other's.
GraphSpec read_spec(const GraphText& text, const std::vector<Grammar>& grammars, bool all_known, Problems& problems);

/// Both, where the grammars are known before the text is read.
GraphSpec load_spec(const std::shared_ptr<const Source>& source, const Overrides& overrides, Problems& problems,
                    const std::vector<Grammar>& grammars = built_in_grammars());

}  // namespace jarol
