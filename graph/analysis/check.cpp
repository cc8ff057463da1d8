#include "graph/analysis/check.h"

#include <cassert>

#include "graph/analysis/policies.h"
#include "graph/language/problems.h"

namespace jarol::analysis {
namespace {

Result check_system(const System& system, bool whole, Effort& effort) {
  return entry_of(system.policy).check(system, whole, effort);
}

}  // namespace

const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::schedulable: return "schedulable";
    case Verdict::not_schedulable: return "not_schedulable";
    case Verdict::unknown: return "unknown";
  }
  return "";
}

Result check(const System& system) {
  Effort effort;
  Result result = check_system(system, true, effort);
  assert(result.response.size() == system.loads.size() && result.core.size() == system.loads.size());
  result.utilisation = utilisation(system.loads);
  return result;
}

Verdict verdict_of(const System& system, Effort& effort) { return check_system(system, false, effort).verdict; }

Result check(const Graph& graph) {
  std::vector<std::string> missing;
  for (const Task& task : graph.tasks)
    if (!task.wcet) missing.push_back("'" + task.name + "'");
  const System system = system_of(graph);
  if (missing.empty()) return check(system);
  Result result;
  result.reason = "no 'wcet' is stated for " + list_of(missing);
  result.utilisation = utilisation(system.loads);
  result.response.resize(graph.tasks.size());
  result.core.resize(graph.tasks.size());
  return result;
}

}  // namespace jarol::analysis
