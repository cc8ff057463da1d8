#include "runtime/machine/thread_time.h"

#include <time.h>

#include <algorithm>
#include <limits>

namespace jarol {

std::int64_t thread_time() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::int64_t thread_time_between_readings(int tries) {
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (int i = 0; i < tries; ++i) {
    const std::int64_t before = thread_time();
    least = std::min(least, thread_time() - before);
  }
  return least;
}

}  // namespace jarol
