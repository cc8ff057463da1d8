// Tasks run on several workers, stage by stage, where that pays; the outcome is that of one worker.
#pragma once

#include <memory>
#include <vector>

#include "runtime/dispatch/dispatcher.h"
#include "runtime/dispatch/releases.h"
#include "runtime/dispatch/stage_team.h"

namespace jarol {
namespace analysis {
class Schedule;
}

class SharedStages : public Dispatcher {
 public:
  /// `alone`: one worker's, for where sharing does not pay. `schedule`: what is late and left out, by which that worker
  /// goes too, or null. All outlive it.
  SharedStages(Run& run, std::size_t workers, Sharing sharing, std::unique_ptr<Dispatcher> alone,
               analysis::Schedule* schedule = nullptr);

  void end_lets(const Now& now) override { alone_->end_lets(now); }
  void release(const Now& now) override;
  std::span<const std::atomic<const RunningTask*>> others() const override { return team_.others(); }

  const StageTeam& team() const { return team_; }

 private:
  using Stage = std::vector<Releases::Released>;
  struct Bad {
    const Activation* activation = nullptr;
    BadActivation went;
  };
  void run_in_order(const Stage& stage, const Now& now);
  void run_level(const Stage& stage, std::uint32_t level, const Now& now);
  void report_bad();

  Run& run_;
  Releases releases_;
  StageTeam team_;
  std::unique_ptr<Dispatcher> alone_;
  analysis::Schedule* const schedule_;
  std::vector<Bad> bad_;  // of the stage under way
};

}  // namespace jarol
