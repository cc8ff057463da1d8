// The way from a task to what offends, as a reader follows it in the source.
#pragma once

#include <string>
#include <vector>

#include "graph/isolation/source_lines.h"
#include "graph/isolation/verify.h"

namespace jarol::isolation {

/// Functions from the task's `run` on, inlined ones too where debug data have them; without what the runtime and the
/// standard library wrap around it.
std::vector<Frame> way_of(const Violation& violation, const SourceLines& lines);

/// "run at clock.cpp:12"
std::string text_of(const Frame& frame);

}  // namespace jarol::isolation
