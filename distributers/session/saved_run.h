// A run that is saved on its way, and one that goes on from what was saved.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "distributers/session/graph_run.h"
#include "distributers/session/noted.h"
#include "distributers/session/pace.h"
#include "runtime/execute/executor_run.h"

namespace jarol {

/// Where a run is saved on its way, and what becomes of that.
struct Stop {
  std::string option;  // that asks for it, as messages name it
  Duration at{};
  std::function<void(Checkpoint)> take;  // may throw
  std::string lost;                      // what there is not if the run does not come there: "'FILE' is not written"
};

/// A run on the virtual clock that is saved on its way, at some pace.
class SavedRun : public ExecutorRun {
 public:
  /// `pace`: null: as fast as possible.
  SavedRun(GraphRun& run, Noted& noted, Duration end, Pace* pace = nullptr)
      : ExecutorRun(run.executor(), end), run_(run), noted_(noted), end_(end), pace_(pace) {}

  /// Before it runs.
  void add(Stop stop);
  /// Besides, before it runs: at each multiple of `every` it is taken, as that option asks for.
  void take_each(std::string option, Duration every, std::function<void(const Checkpoint&)> take) {
    option_of_each_ = std::move(option);
    every_ = every;
    take_each_ = std::move(take);
  }
  /// Throws InputError where the run can't be saved, or does not come there.
  void require_saveable(Duration begin, Duration end);
  void cover() override;
  void close(const Ending& ending, Futex::Time patience) override;

  /// What was lost, and why; empty: nothing.
  const std::string& lost() const { return lost_; }

 private:
  void cover_until(Duration end);
  void cover_to(Duration instant);
  void add_lost(const std::string& text);

  GraphRun& run_;
  Noted& noted_;
  const Duration end_;
  Pace* const pace_;
  std::vector<Stop> stops_;                           // in order of time
  std::function<void(const Checkpoint&)> take_each_;  // empty: none
  std::string option_of_each_;
  Duration every_{}, next_{};      // when
  std::uint64_t taken_after_ = 0;  // instants executed when the newest one was taken
  std::string lost_;
};

Checkpoint checkpoint_of(GraphRun& run, Noted& noted);
/// Throws CheckpointError with the file's name.
void restore(GraphRun& run, Noted& noted, const Checkpoint& checkpoint, const std::string& file);

}  // namespace jarol
