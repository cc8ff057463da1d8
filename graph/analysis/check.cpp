#include "graph/analysis/check.h"

#include <string>
#include <utility>

#include "graph/language/problems.h"
#include "graph/model/deadlines.h"
#include "graph/text/errors.h"

namespace jarol::analysis {
namespace {

// What a plugin's policy throws is not this program's.
Result ask_policy(const System& system, bool whole, Budget& budget) {
  try {
    return system.policy.check(system, whole, budget);
  } catch (...) { rethrow_as_unfinished("policy '" + std::string(system.policy.name) + "'"); }
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
  constexpr std::uint64_t max_steps = 2'000'000'000;  // of all cores together
  Budget budget{max_steps};
  Result result = ask_policy(system, true, budget);
  // the policy of a plugin may leave them out
  result.response.resize(system.models.size());
  result.exact.resize(system.models.size());
  result.core.resize(system.models.size());
  result.utilisation = utilisation(system.models);
  return result;
}

Verdict verdict_of(const System& system, Budget& budget) { return ask_policy(system, false, budget).verdict; }

std::string open_deadline(const Graph& graph) {
  if (graph.platform.phasing != Phasing::any) return "";
  for (const Connection& c : graph.connections) {
    if (c.from.kind != End::Kind::task || graph.tasks[c.from.index].let) continue;
    const Task& producer = graph.tasks[c.from.index];
    const auto differs = [&](const auto& reader) {
      return min_distance(producer.period, producer.offset, reader.period, reader.offset) !=
             min_distance(producer.period, Duration{}, reader.period, Duration{});
    };
    const bool is_task = c.to.kind == End::Kind::task;
    if (is_task ? !differs(graph.tasks[c.to.index]) : !differs(graph.communicators[c.to.index])) continue;
    return "the deadline of '" + producer.name + "' follows from when '" +
           (is_task ? graph.tasks[c.to.index].name : graph.communicators[c.to.index].name) +
           "' reads, and 'phasing: any' leaves that open; give '" + producer.name +
           "' a 'let', or state 'phasing: given'";
  }
  return "";
}

Result check(const Graph& graph) {
  std::vector<std::string> missing;
  for (const Task& task : graph.tasks)
    if (!task.wcet) missing.push_back("'" + task.name + "'");
  const System system = system_of(graph);
  if (missing.empty()) {
    Result result = check(system);
    if (result.verdict != Verdict::schedulable) return result;
    if (std::string open = open_deadline(graph); !open.empty()) {
      result.verdict = Verdict::unknown;
      result.evidence = Evidence::none;
      result.reason = std::move(open);
    }
    return result;
  }
  Result result;
  result.reason = "no 'wcet' is stated for " + list_of(missing);
  result.utilisation = utilisation(system.models);
  result.response.resize(graph.tasks.size());
  result.exact.resize(graph.tasks.size());
  result.core.resize(graph.tasks.size());
  return result;
}

}  // namespace jarol::analysis
