// The recording that a run writes, as options ask for it.
#pragma once

#include <memory>
#include <string>

#include "distributers/session/load.h"
#include "graph/language/source_set.h"
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

/// Null: none is asked for. `header` as far as the options of the run say it; `sources`: what was read to load the
/// graph.
std::unique_ptr<RecordingWriter> make_recording(const RecordArguments& arguments, RecordingHeader header,
                                                const SourceSet& sources, const Loaded& loaded);

/// A line of the report that names it.
std::string to_text(const RecordArguments& arguments);
/// A line of what is not in it, and of a part that it did not begin; or nothing.
std::string notes_of(const RecordArguments& arguments, const RecordingWriter& writer);
/// How often the run is saved in it. Throws std::invalid_argument.
Duration checkpoint_period(const RecordArguments& arguments);

}  // namespace jarol::tools
