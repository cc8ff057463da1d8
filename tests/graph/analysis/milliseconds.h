// A unit that tests of the analysis count times in.
#pragma once

#include "graph/language/duration.h"

namespace jarol::tests {
inline constexpr Duration ms = std::chrono::milliseconds(1);
}  // namespace jarol::tests
