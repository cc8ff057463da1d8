#include "runtime/machine/futex.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <ctime>

namespace jarol {

static_assert(sizeof(std::atomic<std::uint32_t>) == 4 && std::atomic<std::uint32_t>::is_always_lock_free);

bool Futex::wait(std::atomic<std::uint32_t>& word, std::uint32_t old, std::optional<Time> deadline) {
  timespec until{};
  if (deadline) {
    const std::int64_t ns = std::max<std::int64_t>(0, std::chrono::nanoseconds(deadline->time_since_epoch()).count());
    until = {static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
  }
  // unlike FUTEX_WAIT, this one takes an absolute time
  const long result = syscall(SYS_futex, &word, FUTEX_WAIT_BITSET_PRIVATE, old, deadline ? &until : nullptr, nullptr,
                              FUTEX_BITSET_MATCH_ANY);
  return result == 0 || errno != ETIMEDOUT;
}

void Futex::wake_all(std::atomic<std::uint32_t>& word) { syscall(SYS_futex, &word, FUTEX_WAKE_PRIVATE, INT_MAX); }

}  // namespace jarol
