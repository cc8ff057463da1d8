#include "tools/run/checkpoints.h"

#include <algorithm>
#include <stdexcept>

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
  command.add_option("--resume", arguments.resume,
                     "Go on from what was saved of this graph, with its profile, --set and seed; --set may change "
                     "parameters of tasks from there on");
}

void require_checkpoint_effect(const Command& command, const CheckpointArguments& arguments, bool virtual_clock) {
  if (!virtual_clock) command.refuse({"--save", "--resume"}, "belongs to the virtual clock");
  if (arguments.resume.empty()) return;
  command.refuse({"--profile", "--seed"}, "is that of the run that was saved; leave it out");
  command.refuse({"--log", "--record"}, "has to begin at the start of a run, for the replay does; leave out --resume");
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
  std::stable_sort(saves.begin(), saves.end(), [](const Save& a, const Save& b) { return a.at < b.at; });
  return saves;
}

Checkpoint read_checkpoint(const std::string& file, Overrides& overrides, std::uint64_t& seed) {
  Checkpoint read = Checkpoint::read(file);
  const RunOrigin& origin = read.origin();
  overrides.profile = origin.profile;
  std::vector<std::string> set = origin.set;
  std::erase_if(set, names_plugins);
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

void SavedRun::require_saveable(Duration begin, Duration end) {
  if (saves_.empty()) return;
  for (const Save& save : saves_) {
    if (save.at < begin)
      throw std::invalid_argument("--save: the run goes on from " + seconds_text(begin) + " s, after " +
                                  seconds_text(save.at) + " s");
    if (save.at > end)
      throw std::invalid_argument("--save: the run ends at " + seconds_text(end) + " s, before " +
                                  seconds_text(save.at) + " s");
  }
  try {
    checkpoint_of(run_, noted_);
  } catch (const CheckpointError& wrong) { throw std::invalid_argument(std::string("--save: ") + wrong.what()); }
}

void SavedRun::cover() {
  const Report& report = run_.executor().report();
  for (const Save& each : saves_) {
    run_.executor().cover(each.at);
    if (report.covered >= each.at && !report.stopped) {
      save(each);
    } else {
      add_unwritten("'" + each.file + "' is not written, as the run has ended at " + seconds_text(report.simulated) +
                    " s");
    }
  }
  ExecutorRun::cover();
}

// What can't be written does not end the run.
void SavedRun::save(const Save& save) {
  try {
    checkpoint_of(run_, noted_).write(save.file);
    written_.push_back(save);
  } catch (const std::exception& error) { add_unwritten(error.what()); }
}

void SavedRun::add_unwritten(const std::string& text) { unwritten_ += (unwritten_.empty() ? "" : "; ") + text; }

}  // namespace jarol::tools
