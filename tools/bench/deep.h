// What a value of changing size costs on its way.
#pragma once

#include "tools/bench/figures.h"

namespace jarol::bench {

/// A sequence of 1 KiB across a connection, against memcpy of the same bytes.
Figure measure_deep(int repeats);

}  // namespace jarol::bench
