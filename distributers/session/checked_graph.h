// What `jarol check` finds out about a graph's file, as values: the verdict, margins, chains, and what would help.
#pragma once

#include <memory>
#include <vector>

#include "distributers/session/load.h"
#include "distributers/session/note_sink.h"
#include "graph/analysis/check_graph.h"
#include "graph/analysis/remedies.h"

namespace jarol {

struct CheckOptions {
  Overrides overrides{};
  bool sensitivity = false;  // margins and remedies also where finding them takes long
  bool all_chains = false;   // every path from an `in` to an `out`, too
  bool remedies = true;
  NoteSink note = no_notes;
};

struct CheckedGraph {
  Loaded loaded;
  analysis::GraphCheck found;  // of its graph
  std::vector<analysis::Remedy> remedies;
};

/// Throws SpecError with all that is wrong with the graph, its overrides and its links.
CheckedGraph check_graph(const std::shared_ptr<const Source>& source, const distributers::Registries& known,
                         const CheckOptions& options = {});

}  // namespace jarol
