#include "graph/analysis/check.h"

#include "graph/language/problems.h"

namespace jarol::analysis {

const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::schedulable: return "schedulable";
    case Verdict::not_schedulable: return "not_schedulable";
    case Verdict::unknown: return "unknown";
  }
  return "";
}

Result check(const System& system) {
  Budget budget;
  Result result = system.policy.check(system, true, budget);
  // the policy of a plugin may leave them out
  result.response.resize(system.models.size());
  result.exact.resize(system.models.size());
  result.core.resize(system.models.size());
  result.utilisation = utilisation(system.models);
  return result;
}

Verdict verdict_of(const System& system, Budget& budget) { return system.policy.check(system, false, budget).verdict; }

Result check(const Graph& graph) {
  std::vector<std::string> missing;
  for (const Task& task : graph.tasks)
    if (!task.wcet) missing.push_back("'" + task.name + "'");
  const System system = system_of(graph);
  if (missing.empty()) return check(system);
  Result result;
  result.reason = "no 'wcet' is stated for " + list_of(missing);
  result.utilisation = utilisation(system.models);
  result.response.resize(graph.tasks.size());
  result.exact.resize(graph.tasks.size());
  result.core.resize(graph.tasks.size());
  return result;
}

}  // namespace jarol::analysis
