// What `jarol run` prints at its end.
#pragma once

#include <vector>

#include "tools/commands/run/run_options.h"
#include "tools/commands/run/run_report.h"
#include "tools/commands/run/what_if.h"

namespace jarol::tools {

/// `written`: the files that were asked for are there.
void print(const RunArguments& options, const RunOutcome& outcome, const std::vector<Save>& saves,
           const WhatIfs& what_ifs, bool written);

}  // namespace jarol::tools
