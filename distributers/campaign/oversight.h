// What looks over the runs of a campaign, from outside: whether to stop, and which of them has a task that never ends.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <thread>

#include "runtime/execute/executor.h"
#include "runtime/execute/stuck_watch.h"

namespace jarol::campaign {

/// Where the campaign is to stop, and runs go on.
struct WaitNote {
  /// Of how many, once, when that is the case for as long.
  std::function<void(std::size_t runs)> report;
  const std::atomic<bool>& stop;
  std::chrono::milliseconds after{1000};
};

/// Looks after runs under way on any threads, on one of its own.
class StuckRuns {
 public:
  using Report = std::function<void(std::uint64_t run, const HangingTask& task)>;

  explicit StuckRuns(Report report, std::optional<WaitNote> wait = std::nullopt,
                     std::chrono::milliseconds after = StuckNote{}.after);
  ~StuckRuns();

  /// A run is under way while this lives.
  class Watched {
   public:
    Watched(StuckRuns* by, std::uint64_t run, const Executor& executor);
    ~Watched();
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;

   private:
    StuckRuns* by_;  // null: nobody looks
    std::list<StuckWatch>::iterator place_;
  };

 private:
  void look();
  void look_at_stop();

  const Report report_;
  const std::chrono::milliseconds after_;
  std::optional<WaitNote> wait_;  // none: nobody wants to know, or knows
  std::optional<std::chrono::steady_clock::time_point> stops_since_;
  std::mutex mutex_;
  std::condition_variable over_;
  bool is_over_ = false;
  std::list<StuckWatch> runs_;
  std::thread thread_;
};

/// `stop`: a run ends at its next second, without a result. `stuck`: who looks after those that never do; null: nobody.
struct Oversight {
  Oversight(const std::atomic<bool>& stops, StuckRuns* knows = nullptr) : stop(stops), stuck(knows) {}

  const std::atomic<bool>& stop;
  StuckRuns* stuck;
};

}  // namespace jarol::campaign
