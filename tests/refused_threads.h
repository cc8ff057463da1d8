// Threads that can't be had, as of a system that has no room for them.
#pragma once

namespace jarol::tests {

/// While it lives the calling thread gets so many threads more, and then none: std::thread throws. With sanitizers,
/// which make threads their own way, it does nothing.
struct RefusedThreads {
  explicit RefusedThreads(int granted);
  ~RefusedThreads();
  RefusedThreads(const RefusedThreads&) = delete;
  RefusedThreads& operator=(const RefusedThreads&) = delete;

#ifdef JAROL_SANITIZED
  static constexpr bool possible = false;
#else
  static constexpr bool possible = true;
#endif
};

}  // namespace jarol::tests
