// What a replay starts from: the graph of a recording, and a checkpoint in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "distributers/session/graph_run.h"
#include "distributers/session/load.h"
#include "distributers/session/noted.h"
#include "graph/language/source_set.h"
#include "runtime/record/recorded_run.h"

namespace jarol {

/// Those of the run and those given here. A recording is no program: code is loaded only where the user's own words
/// name the file or the plugin that brings it. `file`: in place of the graph of the run; empty: that. `how_named`: how
/// the user names it.
Overrides overrides_of(const Recording& recording, const std::string& file, const Overrides& given,
                       const std::string& how_named);

/// What of the world of a run is loaded with its graph.
enum class RecordedWorld {
  nothing,
  truth,    // where its vehicles truly were, if the recording has that
  systems,  // its external systems, to go on with
};

/// The files that the recording holds, and, where the user adds nothing to what the run was given, no others: a
/// recording may come from anybody, and what it names is not the user's word. `how_named` as above.
void give_recorded(const Recording& recording, const Overrides& overrides, const std::string& how_named,
                   SourceSet& sources);

/// The graph of the run as it was then, or `file` in its place.
Loaded load_recorded(const Recording& recording, const distributers::Registries& known, const std::string& file,
                     const Overrides& overrides, RecordedWorld world, const NoteSink& note,
                     const std::string& how_named);

/// Files that the run has read and that are not what they were, or are gone.
std::vector<std::string> changed_files(const Recording& recording);
bool is_text_of_run(const std::string& file, const Recording& recording);

/// Where a replay begins: at the newest checkpoint not after what is asked for, or where the recording does. `option`:
/// what asks for it. Throws InputError.
Duration replay_begin(const std::optional<Duration>& from, const RecordedRun& log, const std::string& option);

/// The run goes on in this process from its checkpoint at that instant, with what it had noted by then. Throws
/// InputError.
void restore_recorded(GraphRun& run, Noted& noted, const RecordedRun& log, Duration at, RunOrigin origin);

}  // namespace jarol
