// The processor time of the calling thread: it stands still while anything else runs there.
#pragma once

#include <cstdint>

namespace jarol {

/// ns of CLOCK_THREAD_CPUTIME_ID.
std::int64_t thread_time();

/// The least that two readings one after the other differ by, which is what reading takes: 0 if the clock moves in
/// steps too coarse to tell. Tries so often.
std::int64_t thread_time_between_readings(int tries = 1000);

}  // namespace jarol
