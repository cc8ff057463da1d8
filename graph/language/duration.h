// Time as all of it is counted: instants since a run's start, periods, deadlines.
#pragma once

#include <chrono>

namespace jarol {

using Duration = std::chrono::nanoseconds;

}  // namespace jarol
