// Whether the task types of a registry are isolated, by the code that the runtime calls.
#pragma once

#include <string>
#include <vector>

#include "graph/isolation/verify.h"
#include "graph/registry.h"

namespace jarol {

/// Verdicts on some task types whose code lies in the file, in the order of their names. `own`: the file is this
/// program. Throws InputError with words that follow the file's name if it can't be read, or a task's code is
/// elsewhere.
std::vector<isolation::Verdict> verify_tasks(const Registry& registry, const std::vector<std::string>& types,
                                             const std::string& file, bool own);

/// Adds a problem for each task of the graph that promises isolation and whose type is one of those, from the plugin,
/// and does not keep it. What is built with a sanitizer reaches that, and is not looked at.
void check_isolation(const GraphSpec& spec, const Registry& registry, const std::vector<std::string>& types,
                     const std::string& plugin, Problems& problems);

}  // namespace jarol
