#include "distributers/session/pace.h"

#include <algorithm>
#include <utility>

namespace jarol {
namespace {

using namespace std::chrono_literals;

// Pages are shown sixty times a second.
constexpr auto piece = 10ms;
// A machine that is too slow for the speed does not catch up later.
constexpr auto max_behind = 200ms;

}  // namespace

Pace::State Pace::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void Pace::set_speed(std::optional<double> speed) {
  {
    const std::lock_guard lock(mutex_);
    state_.speed = speed;
    anew_ = true;
  }
  changed_.notify_all();
}

void Pace::pause() {
  const std::lock_guard lock(mutex_);
  state_.paused = true;
  steps_ = 0;
}

void Pace::go_on() {
  {
    const std::lock_guard lock(mutex_);
    state_.paused = false;
    steps_ = 0;
    anew_ = true;
  }
  changed_.notify_all();
}

void Pace::step(std::uint64_t instants) {
  {
    const std::lock_guard lock(mutex_);
    state_.paused = true;
    steps_ = std::min(steps_ + instants, max_steps);
  }
  changed_.notify_all();
}

void Pace::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
}

// To where to go on now; none: it is ended.
std::optional<Duration> Pace::next_end(Executor& executor, Duration end) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return ended_ || !state_.paused || steps_ > 0; });
  if (ended_) return std::nullopt;
  if (state_.paused) {
    --steps_;
    return executor.next_instant() < end ? executor.next_instant() + Duration(1) : end;
  }
  const Clock::time_point now = Clock::now();
  // in pieces without a speed, too, so that it can be paused
  if (!state_.speed) return std::min(end, executor.now() + Duration(1s));
  if (std::exchange(anew_, false)) {
    wall_ = now;
    logical_ = executor.now();
  }
  const auto due = logical_ + std::chrono::duration_cast<Duration>((now - wall_) * *state_.speed);
  if (due - executor.now() > std::chrono::duration_cast<Duration>(max_behind * *state_.speed)) anew_ = true;
  return std::clamp(due, executor.now(), end);
}

void Pace::cover(GraphRun& run, Duration end) {
  Executor& executor = run.executor();
  while (executor.report().covered < end && !executor.report().stopped) {
    const std::optional<Duration> next = next_end(executor, end);
    if (!next) return;
    executor.cover(*next);
    if (Recorder* const recorder = run.sinks().recorder()) recorder->hand_on();
    std::unique_lock lock(mutex_);
    if (state_.speed && *next < end) changed_.wait_for(lock, piece, [&] { return ended_ || anew_ || state_.paused; });
  }
}

}  // namespace jarol
