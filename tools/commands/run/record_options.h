// The recording that a run writes, as options ask for it.
#pragma once

#include <string>

#include "distributers/session/run_options.h"
#include "runtime/record/recording_writer.h"

namespace jarol::tools {

class Command;

struct RecordArguments {
  std::string record, log;  // the file, by one of both
  std::string what = "all";
  std::string compression = "lz4";
  std::string split;        // bytes of a file at most, as in 1GiB; empty: one file
  std::string checkpoints;  // how often, as in 10s; empty: never

  const std::string& file() const { return record.empty() ? log : record; }
};

void add_record_options(Command& command, RecordArguments& arguments);

/// Throws where an option would have no effect.
void require_effect(const Command& command, const RecordArguments& arguments);

/// Throws InputError for a size or a period that can't be.
RecordingOptions options_of(const RecordArguments& arguments);

/// A line of the report that names it.
std::string to_text(const RecordArguments& arguments);
/// A line of what is not in it, and of a part that it did not begin; or nothing.
std::string notes_of(const RecordArguments& arguments, const RecordingWriter& writer);

}  // namespace jarol::tools
