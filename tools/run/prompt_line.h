// A line on stderr that waits for nobody.
#pragma once

#include <string_view>

namespace jarol::tools {

/// Writes the line, or no more than its first 4096 bytes, where that does not block now: not to a full pipe, nor to a
/// terminal that is halted. May be called by a signal handler.
void write_promptly(std::string_view line);

}  // namespace jarol::tools
