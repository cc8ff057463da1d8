// How variations are written: 0.3..0.6, normal(0.5, 0.1), [1, 2, 3], grid(0..1, 5); of the seed 1..1000.
#pragma once

#include <optional>

#include "graph/campaign/campaign.h"

namespace jarol::campaign {

/// The value at a path, as YAML; nothing after a report.
std::optional<Variation> read_variation(const std::string& path, const Location& where, const Yaml& yaml,
                                        Problems& problems);

/// "path=0.3..0.6" as it came from the command line.
std::optional<Variation> read_variation(const std::string& argument, Problems& problems);

/// A number of a range or a distribution as it goes into --set: times in whole nanoseconds.
std::string value_text(double number, const std::string& unit);

}  // namespace jarol::campaign
