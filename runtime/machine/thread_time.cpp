#include "runtime/machine/thread_time.h"

#include <time.h>

#include <algorithm>
#include <vector>

namespace jarol {

Duration thread_time() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + Duration(time.tv_nsec);
}

Duration thread_time_between_readings(int tries) {
  std::vector<Duration> differences(static_cast<std::size_t>(tries));
  for (Duration& difference : differences) {
    const Duration before = thread_time();
    difference = thread_time() - before;
  }
  const auto quarter = differences.begin() + tries / 4;
  std::nth_element(differences.begin(), quarter, differences.end());
  return *quarter;
}

}  // namespace jarol
