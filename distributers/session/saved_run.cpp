#include "distributers/session/saved_run.h"

#include <algorithm>
#include <stdexcept>

#include "graph/language/quantities.h"
#include "graph/text/errors.h"

namespace jarol {

Checkpoint checkpoint_of(GraphRun& run, Noted& noted) {
  Checkpoint made = run.checkpoint();
  made.save("notes", noted);
  return made;
}

void restore(GraphRun& run, Noted& noted, const Checkpoint& checkpoint, const std::string& file) {
  try {
    run.require_same_origin(checkpoint);
    run.restore(checkpoint);
    checkpoint.restore("notes", noted);
  } catch (const CheckpointError& wrong) { throw CheckpointError("'" + file + "' " + wrong.what()); }
}

void SavedRun::add(Stop stop) {
  const auto later = [](Duration at, const Stop& other) { return at < other.at; };
  stops_.insert(std::upper_bound(stops_.begin(), stops_.end(), stop.at, later), std::move(stop));
}

void SavedRun::require_saveable(Duration begin, Duration end) {
  for (const Stop& stop : stops_) {
    if (stop.at < begin)
      throw InputError(stop.option + ": the run " + (begin > Duration{} ? "goes on from " : "begins at ") +
                       seconds_text(begin) + " s, after " + seconds_text(stop.at) + " s");
    if (stop.at > end)
      throw InputError(stop.option + ": the run ends at " + seconds_text(end) + " s, before " + seconds_text(stop.at) +
                       " s");
  }
  if (stops_.empty() && !take_each_) return;
  if (take_each_) next_ = begin - begin % every_ + every_;
  try {
    checkpoint_of(run_, noted_);
  } catch (const CheckpointError& wrong) {
    const std::string option = stops_.empty() ? option_of_each_ : stops_.front().option;
    throw InputError(option + ": " + wrong.what());
  }
}

// What can't be written does not end the run.
void SavedRun::cover() {
  const Report& report = run_.executor().report();
  for (const Stop& stop : stops_) {
    cover_until(stop.at);
    if (report.covered < stop.at || report.stopped) {
      add_lost(stop.lost + ", as the run has ended at " + seconds_text(report.simulated) + " s");
      continue;
    }
    try {
      stop.take(checkpoint_of(run_, noted_));
    } catch (const std::exception& error) { add_lost(error.what()); }
  }
  cover_until(end_);
}

// At its pace.
void SavedRun::cover_to(Duration instant) {
  pace_ != nullptr ? pace_->cover(run_, instant) : run_.executor().cover(instant);
}

void SavedRun::close(const Ending& ending, Futex::Time patience) {
  if (pace_ != nullptr) pace_->end();
  ExecutorRun::close(ending, patience);
}

// By way of the instants at which each one is taken.
void SavedRun::cover_until(Duration end) {
  const Report& report = run_.executor().report();
  for (; take_each_ && next_ < end; next_ += every_) {
    cover_to(next_);
    if (report.covered < next_ || report.stopped) return;
    if (std::exchange(taken_after_, report.instants) == report.instants) continue;  // nothing has changed
    try {
      take_each_(checkpoint_of(run_, noted_));
    } catch (const std::exception& error) {
      add_lost(error.what());
      take_each_ = {};
    }
  }
  cover_to(end);
}

void SavedRun::add_lost(const std::string& text) { lost_ += (lost_.empty() ? "" : "; ") + text; }

}  // namespace jarol
