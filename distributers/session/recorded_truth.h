// Where the vehicles of a run truly were, as its recording has it.
#pragma once

#include <memory>
#include <vector>

#include "distributers/session/load.h"
#include "distributers/session/replay.h"
#include "distributers/session/verdict.h"
#include "runtime/record/recorded_run.h"

namespace jarol {

/// External systems that give each `in` communicator what it took, as replayed_systems, and beside that the true
/// values of the vehicles of which `loaded` knows them from the recording. Graph and recording outlive them.
std::vector<std::unique_ptr<ExternalSystem>> recorded_systems(const Loaded& loaded, RecordedRun& run);

/// The same of a run that goes on from what was saved of it: the state of those that it had, one for one, is restored
/// with all else, and nobody looks at it.
std::vector<std::unique_ptr<ExternalSystem>> resumed_systems(const Graph& graph, RecordedRun& run,
                                                             std::vector<std::unique_ptr<ExternalSystem>> saved);

/// By distributer the type of the true values that `loaded` knows; null: none.
std::vector<const Type*> types_of_truth(const Loaded& loaded);

/// Where the replay did otherwise than the run, the vehicle might have gone elsewhere, and conditions on where it was
/// are not judged. `other_graph`: the graph is another text, so that a replay of which nobody knows whether it was the
/// same is taken as one that was not.
void judge_no_other_truth(const Graph& graph, Evidence evidence, bool other_graph, std::vector<Verdict>& verdicts);

}  // namespace jarol
