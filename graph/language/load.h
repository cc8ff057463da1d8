// From the text of a graph to its specification.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

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

/// Reads a graph. All that is wrong goes to `problems`; what could be read is returned.
GraphSpec load_spec(const std::shared_ptr<const Source>& source, const Overrides& overrides, Problems& problems);

}  // namespace jarol
