#include "tools/commands/run/checkpoints.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "graph/language/quantities.h"
#include "runtime/record/recording_format.h"
#include "tools/report/command_line.h"
#include "tools/report/duration_option.h"

namespace jarol::tools {

void add_checkpoint_options(Command& command, CheckpointArguments& arguments) {
  command
      .add_option("--save", arguments.saves,
                  "Save the run when it has reached an instant, as in 30s=FILE; may be given more than once")
      ->one_value();
  command
      .add_option("--resume", arguments.resume,
                  "Go on from what was saved of this graph, with its profile, --set and seed; --set may change "
                  "parameters of tasks from there on")
      ->file();
}

void require_checkpoint_effect(const Command& command, const CheckpointArguments& arguments, bool virtual_clock) {
  if (!virtual_clock)
    command.refuse({"--save", "--resume", "--what-if", "--record-checkpoints"}, "belongs to the virtual clock");
  if (arguments.resume.empty()) return;
  command.refuse({"--profile", "--seed"}, "is that of the run that was saved; leave it out");
}

std::vector<Save> parse_saves(const std::vector<std::string>& words) {
  std::vector<Save> saves;
  for (const std::string& word : words) {
    Save save;
    const std::size_t end = word.find('=');
    if (end == std::string::npos || end + 1 == word.size())
      throw std::invalid_argument("--save: '" + word + "' names no file; write it as in 30s=FILE");
    save.at = duration_of("--save", word.substr(0, end));
    save.file = word.substr(end + 1);
    if (save.file == "-") throw std::invalid_argument("--save: '-' is no file; --resume reads one by its name");
    saves.push_back(std::move(save));
  }
  return saves;
}

Checkpoint read_checkpoint(const std::string& file, Overrides& overrides, std::uint64_t& seed) {
  Checkpoint read = Checkpoint::read(file);
  const RunOrigin& origin = read.origin();
  overrides.profile = origin.profile;
  std::vector<std::string> set = origin.set;
  std::erase_if(set, names_plugins);
  // what is given again as it was is not given twice
  std::erase_if(overrides.set, [&](const std::string& given) {
    const std::string path = given.substr(0, given.find('=') + 1);
    const auto last = std::find_if(set.rbegin(), set.rend(), [&](const std::string& s) { return s.starts_with(path); });
    return last != set.rend() && *last == given;
  });
  overrides.set.insert(overrides.set.begin(), set.begin(), set.end());
  seed = origin.seed;
  return read;
}

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
      throw std::invalid_argument(stop.option + ": the run " + (begin > Duration{} ? "goes on from " : "begins at ") +
                                  seconds_text(begin) + " s, after " + seconds_text(stop.at) + " s");
    if (stop.at > end)
      throw std::invalid_argument(stop.option + ": the run ends at " + seconds_text(end) + " s, before " +
                                  seconds_text(stop.at) + " s");
  }
  if (stops_.empty() && !take_each_) return;
  if (take_each_) next_ = begin - begin % every_ + every_;
  try {
    checkpoint_of(run_, noted_);
  } catch (const CheckpointError& wrong) {
    const std::string option = stops_.empty() ? "--record-checkpoints" : stops_.front().option;
    throw std::invalid_argument(option + ": " + wrong.what());
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

}  // namespace jarol::tools
