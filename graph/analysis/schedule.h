// A platform at work, activation by activation: who runs when, with execution times that are given for each. What
// `check` judges for all times is looked at here for one course of things.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <queue>
#include <vector>

#include "graph/analysis/system.h"

namespace jarol::analysis {

/// What became of an activation.
struct Fate {
  enum class Kind { in_time, late, left_out } kind = Kind::in_time;  // left out: one before it still ran
  std::optional<Duration> response;  // from release to end; none: it had not ended a period after, or never ran
};

class Schedule {
 public:
  /// Of an activation, without overheads of the platform.
  using ExecutionTime = std::function<Duration(std::size_t task, std::int64_t activation)>;

  /// A system with a core for each task, unless the policy has tasks on any. Releases are at the offsets, without
  /// jitter and blocking. `skips`, per task: the release after one that was late is left out, and takes no time.
  Schedule(System system, std::vector<std::size_t> core, std::vector<bool> skips, ExecutionTime execution);

  /// Of each task the activations are asked for in order; those before it are forgotten. One that was forgotten is
  /// looked for from the start.
  const Fate& fate(std::size_t task, std::int64_t activation);

 private:
  struct Job {
    Duration urgency{};     // less first
    std::size_t order = 0;  // of equals
    std::size_t task = 0;
    std::int64_t activation = 0;
    Duration release{};
    Duration left{};
    bool started = false;
  };
  struct OfTask {
    std::vector<std::size_t> producers;  // that it waits for, of its own instant
    std::int64_t released = 0;           // activations, those left out among them
    std::optional<std::int64_t> runs;    // activation
    bool known_late = false;             // that one
    bool skips_next = false;
    std::deque<Fate> fates;  // of `first` and those after it
    std::int64_t first = 0;
  };

  void begin();
  void step();
  void release_due();
  void release(std::size_t task);
  void choose();
  bool waits(const Job& job) const;
  void end(const Job& job);

  const System system_;
  const std::vector<std::size_t> core_;
  const std::vector<bool> skips_;
  const ExecutionTime execution_;
  std::vector<std::size_t> order_;  // per task, of equals
  Duration now_{};
  using Release = std::pair<Duration, std::size_t>;  // when, which task
  std::priority_queue<Release, std::vector<Release>, std::greater<>> releases_;
  std::vector<OfTask> tasks_;
  std::vector<Job> ready_;            // most urgent first
  std::vector<std::size_t> running_;  // of ready_
  std::vector<bool> taken_;           // per core
};

}  // namespace jarol::analysis
