// The control period of the JAviator, as its laws' numbers are tested with.
#pragma once

#include <chrono>

#include "graph/task.h"

namespace jarol::tests {
inline constexpr Tick tick{.now = {}, .activation = 0, .period = std::chrono::milliseconds(15)};
inline constexpr double dt = 0.015;      // s
inline constexpr double g_earth = 9.81;  // m/s^2
}  // namespace jarol::tests
