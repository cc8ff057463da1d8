#include "tools/commands/check/check_words.h"

#include <fmt/format.h>
#include <algorithm>

#include "graph/analysis/policies.h"

namespace jarol::tools {

std::string assumption(const Graph& graph) {
  const Platform& platform = graph.platform;
  const Policy& policy = analysis::policy_of(platform);
  const std::string how = std::string(policy.how) + (policy.executed ? "" : "; 'run' does not execute this");
  std::string overhead = ", without overhead";
  if (platform.dispatch > Duration{} || platform.copy > Duration{})
    overhead = ", with " + duration_text(platform.dispatch) + " for each activation and " +
               duration_text(platform.copy) + " for each byte handed on";
  const bool has_cores = std::any_of(graph.tasks.begin(), graph.tasks.end(), [](const Task& t) { return t.core; });
  return how + overhead + (has_cores && !policy.keeps_core ? "; 'core' is ignored" : "") +
         (platform.phasing == Phasing::any ? "; whatever the offsets" : "");
}

std::string word_of(analysis::Evidence evidence) {
  switch (evidence) {
    case analysis::Evidence::none: return "none";
    case analysis::Evidence::proof: return "proof";
    case analysis::Evidence::safe: return "safe";
    case analysis::Evidence::by_run: return "by a run";
  }
  return "";
}

}  // namespace jarol::tools
