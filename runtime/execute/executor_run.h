// An executor as whoever attends it sees it.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/execute/attend.h"
#include "runtime/execute/executor.h"

namespace jarol {

/// The executor until that instant.
class ExecutorRun : public AttendedRun {
 public:
  /// On the real clock a graph with `at_end` has its vehicle brought to rest then, and `on_rest` is called with the
  /// instant from which on.
  ExecutorRun(
      Executor& executor, Duration end, std::optional<Duration> longest_rest = {},
      std::function<void(Duration)> on_rest = [](Duration) {})
      : executor_(executor), end_(end), longest_rest_(longest_rest), on_rest_(std::move(on_rest)) {}
  void cover() override {
    executor_.cover(end_);
    const std::optional<Duration> rest = longest_rest_ ? executor_.begin_rest() : std::nullopt;
    if (!rest) return;
    on_rest_(*rest);
    executor_.cover_rest();
  }
  std::optional<Duration> longest_rest() const override { return longest_rest_; }
  void ask_for_rest() override { executor_.ask_for_rest(); }
  bool resting() const override { return executor_.resting(); }
  bool stopped_by_fault() const override { return executor_.report().stopped; }
  void close(const Ending&, Futex::Time patience) override { executor_.close(patience); }
  std::optional<Holdup> holdup() const override { return executor_.holdup(); }
  std::optional<Call> call() const override { return executor_.call(); }
  std::vector<HangingTask> running() const override { return executor_.running(); }
  Finish finish(Futex::Time patience) override { return executor_.finish(patience); }

 private:
  Executor& executor_;
  Duration end_;
  std::optional<Duration> longest_rest_;
  std::function<void(Duration)> on_rest_;
};

}  // namespace jarol
