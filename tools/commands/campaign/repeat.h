// The command that repeats one run of a campaign.
#pragma once

#include <optional>
#include <string>

#include "graph/campaign/draws.h"
#include "graph/language/load.h"

namespace jarol::tools {

/// "jarol run FILE ...": of the campaign's own changes, then those of the run. `length` of a run; none: its mission's.
std::string repeat_command(const std::string& file, const Overrides& overrides, std::optional<Duration> length,
                           const campaign::Start& start);

}  // namespace jarol::tools
