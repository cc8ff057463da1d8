#include "runtime/machine/asked_to_end.h"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace jarol {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<std::int64_t> asked_at{0};  // ns of that clock; 0: nobody has asked

std::int64_t monotonic_ns() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

void ask_to_end() {
  std::int64_t before = 0;
  asked_at.compare_exchange_strong(before, monotonic_ns());
}

void forget_asked_to_end() { asked_at.store(0); }

bool has_waited_enough(Clock::time_point since) {
  const std::int64_t asked = asked_at.load(std::memory_order_relaxed);
  return asked != 0 && Clock::now() - std::max(since, Clock::time_point(Clock::duration(asked))) >= patience_at_end;
}

}  // namespace jarol
