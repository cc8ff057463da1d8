// What would turn a "no" of `jarol check` into a "yes": changes of the graph, each checked again.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "graph/analysis/task_model.h"
#include "graph/language/load.h"
#include "graph/registry.h"

namespace jarol::tools {

struct CheckReport;

struct Remedy {
  std::string text;              // "'offset: 2ms' of 'fast'"
  std::vector<std::string> set;  // the same as `--set` takes it
};

/// The best few. First what `run` executes with no other code: an offset, a deadline, priorities by deadline, another
/// policy, another core, more cores, a LET or tasks without theirs, periods, two of these together; then shorter WCETs
/// and policies that are analysed only. Where the tasks that state a core fill it beyond all time, another core comes
/// first. Each keeps the limits of all chains, too. Fewer where it would take more effort.
std::vector<Remedy> find_remedies(const std::shared_ptr<const Source>& source, const Overrides& overrides,
                                  const Registry& registry, const CheckReport& report, analysis::Budget& budget);

}  // namespace jarol::tools
