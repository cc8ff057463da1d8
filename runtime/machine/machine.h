// What this machine allows a program with deadlines, and how late its bare sleeps end.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "runtime/machine/histogram.h"

namespace jarol {

/// Each fact is found by trying it on a thread of its own, or in this process for a moment; nothing stays changed.
struct MachineFacts {
  std::string kernel;                        // release
  bool preempt_rt = false;                   // a kernel with full preemption
  int cpus = 0;                              // that the machine has
  std::vector<int> usable;                   // CPUs that this process may use
  std::string affinity_refused;              // why a thread can't be bound to one CPU; empty: it can
  int fifo_priority = 0;                     // the highest of SCHED_FIFO that is permitted; 0: none
  std::string fifo_refused;                  // why not
  std::string lock_refused;                  // why memory can't be locked; empty: it can
  std::chrono::nanoseconds default_slack{};  // of timers
  std::chrono::nanoseconds min_slack{};      // to which it can be set
  std::chrono::nanoseconds resolution{};     // of CLOCK_MONOTONIC
  std::vector<std::string> governors;        // of CPU frequencies, each once; empty: the machine does not report
};

MachineFacts find_machine_facts();

/// From each instant of a loop of absolute sleeps to the moment at which the thread ran again, on a thread of its own
/// with 1 ns of timer slack. With a priority under SCHED_FIFO; nothing if that is refused.
std::optional<Histogram> measure_lateness(std::chrono::nanoseconds period, std::chrono::nanoseconds duration,
                                          std::optional<int> fifo_priority);

}  // namespace jarol
