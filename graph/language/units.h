// The units in which a number can be written.
#pragma once

#include <string>
#include <vector>

namespace jarol {

/// Those of a number that is in this unit: itself first, and those that convert to it.
std::vector<std::string> units_for(const std::string& unit);

}  // namespace jarol
