// From a file name to a graph that can run, joined to its world: what every session does first.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "distributers/registries.h"
#include "distributers/session/note_sink.h"
#include "graph/campaign/campaign.h"
#include "graph/expect/names.h"
#include "graph/language/load.h"
#include "graph/model/graph.h"
#include "runtime/external_system.h"
#include "runtime/record/recording_format.h"

namespace jarol {

struct Loaded {
  std::unique_ptr<distributers::Registries> known;  // with what the graph's plugins bring
  std::unique_ptr<Graph> graph;
  std::vector<std::unique_ptr<ExternalSystem>> systems;
  std::vector<std::shared_ptr<const Source>> files{};  // the graph's, then what its links name
  campaign::Campaign campaign{};                       // of the key of that name
  std::vector<expect::TrueValues> true_values{};       // what is known of the vehicle of each distributer
  GraphSpec spec{};                                    // what the file says, overrides included
};

/// Throws SpecError with everything that is wrong with the file, its overrides and its links. The seed is that of all
/// noise. A plugin is noted, "loads plugin 'path'", before it is loaded; so is what is doubtful about a link, and which
/// instruments of a distributer are not fitted: its parameters that are structs in which a boolean `fitted` is false.
/// The links of distributers whose names fit one of `without_link`, with * for any part, are not looked at: a null
/// stands in the place of their systems. `known` of another load of a graph with the same plugins: they are not loaded
/// again.
Loaded load_graph(const std::shared_ptr<const Source>& source, const distributers::Registries& known,
                  const Overrides& overrides, std::uint64_t seed, const NoteSink& note = no_notes,
                  const std::vector<std::string>& without_link = {});

/// Does the name fit one of the patterns, with * for any part?
bool fits(const std::string& name, const std::vector<std::string>& patterns);

/// The same without external systems: of the files that links name, missions alone are read, for what they expect.
/// `recorded`: the true values of vehicles that this recording holds are known; null: none.
Loaded load_without_systems(const std::shared_ptr<const Source>& source, const distributers::Registries& known,
                            const Overrides& overrides, const NoteSink& note = no_notes,
                            const RecordingHeader* recorded = nullptr);

/// A distributer whose external system goes on by itself, whatever the logical clock says; null: none does.
const Distributer* find_in_real_time(const Loaded& loaded);

}  // namespace jarol
