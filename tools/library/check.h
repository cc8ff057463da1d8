// What `jarol check` finds out, for a program.
//
//   const jarol::CheckedGraph checked = jarol::check("dive.yaml", {.overrides = {"", {"tasks.speed.wcet=60ms"}}});
//   CHECK(checked.found.result.verdict == jarol::analysis::Verdict::not_schedulable);
//   CHECK(checked.remedies.front().text == "'let: 62.5ms' of 'speed'");
#pragma once

#include <string>

#include "distributers/session/checked_graph.h"
#include "distributers/session/measure.h"
#include "tools/library/built_in.h"

namespace jarol {

/// As check_graph, of a file with all that is built in. Throws as that; WrongBuild.
CheckedGraph check(const std::string& path, const CheckOptions& options = {},
                   const BuildOptions& program = options_of_this_file());

}  // namespace jarol
