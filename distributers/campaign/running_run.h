// Which run of a campaign a thread does, for the line that says in which a program crashed. Each thread writes its own,
// and only a signal handler of the same thread reads it.
#pragma once

#include <atomic>
#include <cstdint>

namespace jarol::campaign {

inline constexpr std::int64_t no_run = -1;

inline constinit thread_local std::atomic<std::int64_t> running_run{no_run};

/// The calling thread does that run while this lives.
class RunningRun {
 public:
  explicit RunningRun(std::uint64_t index) {
    running_run.store(static_cast<std::int64_t>(index), std::memory_order_relaxed);
  }
  ~RunningRun() { running_run.store(no_run, std::memory_order_relaxed); }
  RunningRun(const RunningRun&) = delete;
  RunningRun& operator=(const RunningRun&) = delete;
};

}  // namespace jarol::campaign
