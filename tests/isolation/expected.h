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

/// What differs in what `jarol isolation` finds in a library of that source, a line each.
std::string differences(const std::string& library, const std::string& source);

/// Of tasks that are rejected and should not be, or the other way round, a line each. Not of those before which the
/// source says "may be rejected at -O0" if that is the `level`: there code stays in that is never reached.
std::string wrong_verdicts(const std::string& library, const std::string& source, const std::string& level);

/// The sources, without folder and extension.
std::vector<std::string> isolation_sources();

}  // namespace verdicts
