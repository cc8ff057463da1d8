// What would turn a "no" into a "yes": changes of the graph, each checked again.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "graph/analysis/check_graph.h"
#include "graph/analysis/task_model.h"
#include "graph/language/load.h"
#include "graph/registry.h"

namespace jarol::analysis {

struct Remedy {
  std::string text;              // "'offset: 2ms' of 'fast'"
  std::vector<std::string> set;  // the same as an override takes it
};

/// Does the graph load with these overrides, as vehicles and links may have a word in it?
using Loads = std::function<bool(const Overrides&)>;

/// The best few. First what is executed with no other code: an offset, a deadline, priorities by deadline, another
/// policy, another core, more cores, a LET or tasks without theirs, periods, two of these together; then shorter WCETs
/// and policies that are analysed only. Where the tasks that state a core fill it beyond all time, another core comes
/// first. Each keeps the limits of all chains, too. Fewer where it would take more effort; none where nothing is wrong,
/// or a task has no WCET.
std::vector<Remedy> find_remedies(const std::shared_ptr<const Source>& source, const Overrides& overrides,
                                  const Registry& registry, const GraphCheck& found, const Loads& loads,
                                  Budget& budget);

}  // namespace jarol::analysis
