// What the sources beside this file say that is to be found in them.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace verdicts {

/// "offends: KIND: SYMBOL: PATH" before a TASK.
struct Expected {
  std::string kind, symbol, path;
};

/// By the task's name; empty: it is isolated.
std::map<std::string, std::vector<Expected>> expected_in(const std::string& source);

/// What differs in what `jarol isolation` finds in a library of that source, a line each; without `paths` those may be
/// any that there are.
std::string differences(const std::string& library, const std::string& source, bool paths);

/// The sources, without folder and extension.
std::vector<std::string> isolation_sources();

}  // namespace verdicts
