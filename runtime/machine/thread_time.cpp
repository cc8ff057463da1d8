#include "runtime/machine/thread_time.h"

#include <time.h>

#include <algorithm>
#include <vector>

namespace jarol {

std::int64_t thread_time() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::int64_t thread_time_between_readings(int tries) {
  std::vector<std::int64_t> differences(static_cast<std::size_t>(tries));
  for (std::int64_t& difference : differences) {
    const std::int64_t before = thread_time();
    difference = thread_time() - before;
  }
  const auto quarter = differences.begin() + tries / 4;
  std::nth_element(differences.begin(), quarter, differences.end());
  return *quarter;
}

}  // namespace jarol
