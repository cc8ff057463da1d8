// Activations that take so long that they may never end.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>
#include <vector>

#include "runtime/machine/futex.h"
#include "runtime/run/ending.h"

namespace jarol {

/// Who wants to know of them; each is reported once.
struct StuckNote {
  std::function<void(const HangingTask&)> report = [](const HangingTask&) {};
  std::chrono::milliseconds after{10'000};
};

/// What has run since it was first seen: looked at now and then, and reported once.
class StuckWatch {
 public:
  /// `running`: what a run runs now.
  StuckWatch(std::function<std::vector<HangingTask>()> running, StuckNote note)
      : running_(std::move(running)),
        note_(std::move(note)),
        between_(std::min<Futex::Time::duration>(note_.after / 4, std::chrono::seconds(1))) {}

  void look() {
    const Futex::Time now = Futex::now();
    if (now < next_) return;
    next_ = now + between_;
    std::vector<Seen> seen;
    for (HangingTask& task : running_()) {
      const auto before = std::find_if(seen_.begin(), seen_.end(), [&](const Seen& s) { return s.task == task; });
      seen.push_back(before == seen_.end() ? Seen{std::move(task), now, false} : std::move(*before));
      if (seen.back().reported || now - seen.back().since < note_.after) continue;
      seen.back().reported = true;
      note_.report(seen.back().task);
    }
    seen_ = std::move(seen);
  }

 private:
  struct Seen {
    HangingTask task;
    Futex::Time since;
    bool reported;
  };
  std::function<std::vector<HangingTask>()> running_;
  StuckNote note_;
  Futex::Time::duration between_;
  Futex::Time next_ = Futex::now() + between_;
  std::vector<Seen> seen_;
};

}  // namespace jarol
