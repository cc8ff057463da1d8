// The recording of a run, as its options ask for it.
#pragma once

#include <memory>

#include "distributers/session/load.h"
#include "distributers/session/run_options.h"
#include "runtime/record/recording_writer.h"

namespace jarol {

/// Null: none is asked for. What it does not hold, and a replay has to be given again, is noted. Throws
/// InputError where `what` names nothing.
std::unique_ptr<RecordingWriter> make_recording(const RunOptions& options, const Loaded& loaded);

}  // namespace jarol
