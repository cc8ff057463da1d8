// How fast a run on the virtual clock goes on beside the wall clock: for people who watch, who may also halt it and go
// on instant by instant. The run itself is the same.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

#include "distributers/session/graph_run.h"

namespace jarol {

class Pace {
 public:
  /// Logical seconds in one of the wall clock; none: as fast as possible.
  explicit Pace(std::optional<double> speed) : state_{speed} {}

  // by anyone who watches

  struct State {
    std::optional<double> speed;
    bool paused = false;
    bool operator==(const State&) const = default;
  };
  State state() const;
  void set_speed(std::optional<double> speed);
  /// Steps that are not taken yet are dropped.
  void pause();
  void go_on();
  /// So many instants more, at most max_steps, then it is paused.
  void step(std::uint64_t instants);
  /// `cover` returns soon.
  void end();

  /// By the thread that covers instants: up to that one, or less where it is ended.
  void cover(GraphRun& run, Duration end);

  static constexpr double min = 0.001, max = 1000;
  /// That are asked for and not taken yet.
  static constexpr std::uint64_t max_steps = 10000;

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<Duration> next_end(Executor& executor, Duration end);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  State state_;
  std::uint64_t steps_ = 0;  // to be taken though it is paused
  bool ended_ = false;
  bool anew_ = true;  // the wall clock counts from now on
  Clock::time_point wall_{};
  Duration logical_{};
};

}  // namespace jarol
