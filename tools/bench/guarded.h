// What it costs that tasks can write to nothing but their own memory: run --guard.
#pragma once

#include "tools/bench/figures.h"

namespace jarol::bench {

/// Microseconds of one activation under guard, of a chain of ten tasks; the floor is a microsecond. By the main thread.
Figure measure_guard(const std::string& name, int repeats);

}  // namespace jarol::bench
