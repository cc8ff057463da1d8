// A line on stderr that waits for nobody.
#pragma once

#include <string>
#include <string_view>

#include "runtime/run/ending.h"

namespace jarol::tools {

/// Writes the line, or no more than its first 4096 bytes, where that does not block now: not to a full pipe, nor to a
/// terminal that is halted. May be called by a signal handler.
void write_promptly(std::string_view line);

/// A note, likewise.
void note_promptly(const std::string& text);

/// Likewise, of an activation that has run for long.
void report_stuck(const HangingTask& task);
/// Likewise, in a run of a campaign.
void report_stuck_in_run(std::uint64_t run, const HangingTask& task);
/// Likewise, of runs under way of a campaign that was interrupted.
void report_waits_for_runs(std::size_t runs);

}  // namespace jarol::tools
