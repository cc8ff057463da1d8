#include "tools/commands/check/check_words.h"

#include <fmt/format.h>
#include <algorithm>

#include "graph/analysis/policies.h"

namespace jarol::tools {

std::optional<bool> holds(const ReportedChain& c) {
  if (analysis::broken_limits(c.chain, c.latency).empty()) return true;
  return c.latency.exact ? std::optional(false) : std::nullopt;
}

const Task* longer_than_stated(const CheckReport& r) {
  if (!r.measured) return nullptr;
  const Task* worst = nullptr;
  Duration max_over{};
  for (std::size_t i = 0; i < r.graph->tasks.size(); ++i) {
    const Task& task = r.graph->tasks[i];
    const Duration over = task.wcet ? r.measured->tasks[i].max - *task.wcet : Duration{};
    if (over <= max_over) continue;
    max_over = over;
    worst = &task;
  }
  return worst;
}

std::optional<bool> chains_hold(const CheckReport& report) {
  std::optional<bool> all = true;
  for (const ReportedChain& chain : report.chains) {
    const std::optional<bool> one = holds(chain);
    if (one == false) return false;
    if (!one) all.reset();
  }
  return all;
}

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
