#include "distributers/campaign/oversight.h"

#include <algorithm>
#include <utility>

namespace jarol::campaign {

StuckRuns::StuckRuns(Report report, std::optional<WaitNote> wait, std::chrono::milliseconds after)
    : report_(std::move(report)), after_(after), wait_(std::move(wait)), thread_([this] { look(); }) {}

StuckRuns::~StuckRuns() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  over_.notify_all();
  thread_.join();
}

void StuckRuns::look() {
  const auto between = std::min<std::chrono::milliseconds>(after_ / 4, std::chrono::seconds(1));
  std::unique_lock lock(mutex_);
  while (!over_.wait_for(lock, between, [this] { return is_over_; })) {
    look_at_stop();
    for (StuckWatch& run : runs_) run.look();
  }
}

void StuckRuns::look_at_stop() {
  if (!wait_ || !wait_->stop || runs_.empty()) return;
  const auto now = std::chrono::steady_clock::now();
  if (!stops_since_) stops_since_ = now;
  if (now - *stops_since_ < wait_->after) return;
  wait_->report(runs_.size());
  wait_.reset();
}

StuckRuns::Watched::Watched(StuckRuns* by, std::uint64_t run, const Executor& executor) : by_(by) {
  if (by_ == nullptr) return;
  const StuckNote note{[by, run](const HangingTask& task) { by->report_(run, task); }, by_->after_};
  const std::lock_guard lock(by_->mutex_);
  place_ = by_->runs_.emplace(
      by_->runs_.end(), [&executor] { return executor.running(); }, note);
}

StuckRuns::Watched::~Watched() {
  if (by_ == nullptr) return;
  const std::lock_guard lock(by_->mutex_);
  by_->runs_.erase(place_);
}

}  // namespace jarol::campaign
