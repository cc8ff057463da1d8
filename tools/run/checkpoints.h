// Runs that are saved, and that go on from what was saved.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "distributers/session/graph_run.h"
#include "runtime/execute/executor_run.h"
#include "tools/report/noted.h"

namespace jarol::tools {

class Command;

struct CheckpointArguments {
  std::vector<std::string> saves;  // "30s=FILE"
  std::string resume;              // a file; empty: the run begins at its start
};

void add_checkpoint_options(Command& command, CheckpointArguments& arguments);
/// Options that say nothing here.
void require_checkpoint_effect(const Command& command, const CheckpointArguments& arguments, bool virtual_clock);

/// Where a run is to be saved.
struct Save {
  Duration at{};
  std::string file;
};

/// In order of time. Throws std::invalid_argument.
std::vector<Save> parse_saves(const std::vector<std::string>& words);

/// What a run goes on from; its profile, what it set, but for plugins, and its seed come before what is given here.
Checkpoint read_checkpoint(const std::string& file, Overrides& overrides, std::uint64_t& seed);

/// A run that is saved on its way.
class SavedRun : public ExecutorRun {
 public:
  SavedRun(GraphRun& run, Noted& noted, Duration end, std::vector<Save> saves)
      : ExecutorRun(run.executor(), end), run_(run), noted_(noted), saves_(std::move(saves)) {}

  /// Throws std::invalid_argument where the run can't be saved, or ends before it is to be.
  void require_saveable(Duration begin, Duration end);
  void cover() override;

  /// What was written: a line each; and what was not, as errors.
  const std::vector<Save>& written() const { return written_; }
  const std::string& unwritten() const { return unwritten_; }

 private:
  void save(const Save& save);
  void add_unwritten(const std::string& text);

  GraphRun& run_;
  Noted& noted_;
  std::vector<Save> saves_, written_;
  std::string unwritten_;
};

Checkpoint checkpoint_of(GraphRun& run, Noted& noted);
/// Throws CheckpointError with the file's name.
void restore(GraphRun& run, Noted& noted, const Checkpoint& checkpoint, const std::string& file);

}  // namespace jarol::tools
