// What the verdict on a large graph takes, beyond loading it.
#pragma once

#include "tools/bench/figures.h"

namespace jarol::bench {

/// `tasks` tasks at automotive periods under fixed priorities, with response times; `goal` in ms.
Figure measure_check(const std::string& name, int tasks, double goal, int repeats);

}  // namespace jarol::bench
