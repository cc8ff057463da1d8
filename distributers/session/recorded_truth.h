// Where the vehicles of a run truly were, as its recording has it.
#pragma once

#include <memory>
#include <vector>

#include "distributers/session/load.h"
#include "runtime/record/recorded_run.h"

namespace jarol {

/// Channels that give each `in` communicator what it took, as replayed_channels, and beside that the true values of
/// the vehicles of which `loaded` knows them from the recording. Graph and recording outlive them.
std::vector<std::unique_ptr<ExternalSystem>> recorded_channels(const Loaded& loaded, RecordedRun& run);

/// By distributer the type of the true values that `loaded` knows; null: none.
std::vector<const Type*> types_of_truth(const Loaded& loaded);

}  // namespace jarol
