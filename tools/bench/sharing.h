// What two workers give.
#pragma once

#include "tools/bench/figures.h"

namespace jarol::bench {

/// On bodies that are too short to be shared: a second worker never hurts.
Figure measure_tiny(int repeats);
/// On bodies of 10 us, against two free threads.
Figure measure_10us(int repeats);

}  // namespace jarol::bench
