#include "tools/check/check_words.h"

#include <fmt/format.h>
#include <algorithm>

#include "graph/analysis/policies.h"

namespace jarol::tools {

bool holds(const ReportedChain& c) { return analysis::broken_limits(c.chain, c.latency).empty(); }

const Task* longer_than_stated(const CheckReport& r) {
  if (!r.measured) return nullptr;
  const Task* worst = nullptr;
  Duration most_over{};
  for (std::size_t i = 0; i < r.graph->tasks.size(); ++i) {
    const Task& task = r.graph->tasks[i];
    const Duration over = task.wcet ? r.measured->tasks[i].most - *task.wcet : Duration{};
    if (over <= most_over) continue;
    most_over = over;
    worst = &task;
  }
  return worst;
}

bool chains_hold(const CheckReport& report) { return std::all_of(report.chains.begin(), report.chains.end(), holds); }

std::string assumption(const Platform& platform) {
  const Policy& policy = analysis::policy_of(platform);
  const std::string how = std::string(policy.how) + (policy.executed ? "" : "; 'run' does not execute this");
  std::string overhead = ", without overhead";
  if (platform.dispatch > Duration{} || platform.copy > Duration{})
    overhead = ", with " + duration_text(platform.dispatch) + " for each activation and " +
               duration_text(platform.copy) + " for each byte handed on";
  return how + overhead + (platform.phasing == Phasing::any ? "; whatever the offsets" : "");
}

std::string word_of(analysis::Standing standing) {
  switch (standing) {
    case analysis::Standing::none: return "none";
    case analysis::Standing::proof: return "proof";
    case analysis::Standing::safe: return "safe";
    case analysis::Standing::by_run: return "by a run";
  }
  return "";
}

}  // namespace jarol::tools
