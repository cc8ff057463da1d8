// The control period of the submarine, as its laws are tested with.
#pragma once

#include <chrono>

#include "graph/task.h"

namespace jarol::tests {
inline const Tick every_50_ms{.period = std::chrono::milliseconds(50)};
}  // namespace jarol::tests
