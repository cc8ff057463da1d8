// Logical time tied to CLOCK_MONOTONIC: when an instant of the plan is due in reality, and how well it was met.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/machine/histogram.h"

namespace jarol {

struct RealTimeOptions {
  std::optional<int> priority;  // SCHED_FIFO, 1 to 99; none: the ordinary scheduler
  std::vector<int> cpus;        // where it may run; empty: anywhere
  bool spin = false;            // wait without sleeping at the end, for less lateness at the cost of a CPU
  std::vector<int> core_cpus;   // where several threads run tasks: the CPU of each core; empty: anywhere

  /// Of a thread that runs tasks while another one, that of these options, keeps the time: below it in priority, the
  /// less urgent the lower.
  RealTimeOptions of_thread(std::size_t core, std::size_t urgency) const;
};

/// How an ordinary user is permitted what the system refuses by default.
inline constexpr std::string_view permit_fifo =
    "allow it by the line '@realtime - rtprio 99' in /etc/security/limits.conf and 'adduser USER realtime' after "
    "'addgroup realtime', then log in anew; or run as root";
inline constexpr std::string_view permit_locked_memory =
    "allow it by the line '@realtime - memlock unlimited' in /etc/security/limits.conf, as for SCHED_FIFO";

/// Gives the calling thread its priority (without one, a short slice of the ordinary scheduler), CPUs, timer slack of
/// 1 ns and locked memory; a plain sentence for each that this machine does not permit. Threads that it makes from then
/// on take all of that after it. Under a limit to locked memory only what is allocated by now is locked.
std::vector<std::string> prepare_thread(const RealTimeOptions& options);

/// How long the activations of one task took, and how many were not in time.
struct TaskTiming {
  Histogram execution;         // without what preempted it
  Histogram response;          // from the release to the end
  std::uint64_t late = 0;      // finished after the deadline
  std::uint64_t left_out = 0;  // as the one before still ran
  Duration busy_until{};
};

class RealClock {
 public:
  /// For a graph of so many tasks.
  explicit RealClock(std::size_t tasks, RealTimeOptions options = {});

  const RealTimeOptions& options() const { return options_; }

  /// The calling thread keeps the time.
  std::vector<std::string> prepare_thread() const { return jarol::prepare_thread(options_); }

  /// Instant 0 is now.
  void start();

  /// Since instant 0, at which it stands until `start`; any thread.
  Duration now() const {
    const Duration start = start_.load(std::memory_order_relaxed);
    return start == Duration{} ? start : monotonic() - start;
  }

  /// Returns at the instant, or when `interrupted` is seen, at most a tenth of a second later; counts the lateness.
  void wait_until(Duration instant, const std::atomic<bool>& interrupted);

  TaskTiming& timing(std::size_t task) { return timings_[task]; }
  const TaskTiming& timing(std::size_t task) const { return timings_[task]; }

  /// From an instant to the moment at which its work began.
  const Histogram& lateness() const { return lateness_; }

  /// CLOCK_MONOTONIC.
  static Duration monotonic();

 private:
  RealTimeOptions options_;
  std::atomic<Duration> start_{};    // 0: not started
  std::vector<TaskTiming> timings_;  // per task
  Histogram lateness_;
};

}  // namespace jarol
