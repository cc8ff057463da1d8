// The processor time of the calling thread: it stands still while anything else runs there.
#pragma once

#include "graph/language/duration.h"

namespace jarol {

/// CLOCK_THREAD_CPUTIME_ID.
Duration thread_time();

/// What two readings one after the other differ by, which is what reading takes: a quarter of so many tries differ by
/// no more. 0 if the clock moves in steps too coarse to measure. Not the minimum: on a busy machine one pair in a
/// million was seen to differ by nothing.
Duration thread_time_between_readings(int tries = 1000);

}  // namespace jarol
