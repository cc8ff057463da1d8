#include "tools/commands/run/run_report.h"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/machine/arithmetic.h"
#include "tools/commands/run/real_time.h"
#include "tools/commands/run/threads_report.h"
#include "tools/report/fault_report.h"
#include "tools/report/guard_report.h"
#include "tools/report/noted_report.h"
#include "tools/report/rest_report.h"
#include "tools/report/value_json.h"
#include "tools/report/verdicts.h"

namespace jarol::tools {
namespace {

bool has_weak_isolation(const Graph& graph) {
  return std::any_of(graph.tasks.begin(), graph.tasks.end(),
                     [](const Task& task) { return task.isolation == Isolation::weak; });
}

}  // namespace

double real_time_factor(const RunOutcome& outcome) {
  return static_cast<double>((outcome.simulated - outcome.begun).count()) * 1e-9 / outcome.seconds;
}

std::string to_text(const RunOutcome& outcome) {
  const Graph& graph = outcome.graph();
  const Report& report = outcome.report;
  std::string text = reached_text(
      graph, [&](std::size_t communicator) { return outcome.last_value(communicator); }, outcome.true_states);
  text += fmt::format("  activations {}, instants {}\n  digest      0x{:016x}\n", report.activations, report.instants,
                      report.digest);
  if (outcome.threads != nullptr) text += "              nothing is claimed of the digest: its tasks ran on threads\n";
  for (const Task& task : graph.tasks)
    if (task.isolation == Isolation::weak)
      text += "              nothing is claimed of the digest: task '" + task.name + "' is weakly isolated\n";
  for (const std::string& warning : warnings(find_arithmetic())) text += "  note        " + warning + "\n";
  for (std::size_t i = 0; i < graph.tasks.size(); ++i)
    if (const PrivateHeap* heap = outcome.state.heaps[i])
      text += fmt::format("  heap        {}: at most {} of {} bytes in use\n", graph.tasks[i].name, heap->max_used(),
                          heap->size());
  text += to_text(outcome.noted.reported.kept()) + to_text(outcome.noted.logged.kept());
  if (outcome.clock != nullptr) text += to_text(graph, *outcome.clock);
  if (outcome.threads != nullptr) text += to_text(graph, *outcome.threads);
  for (const LinkReport& link : outcome.links) text += to_text(link);
  text += to_text(graph, outcome.rest, outcome.end);
  text += to_text(graph, outcome.failsafe, outcome.end.ending);
  if (outcome.guard != nullptr) text += to_text(*outcome.guard);
  if (report.non_finite_inputs > 0)
    text += fmt::format("  {} values from outside were not finite and not taken\n", report.non_finite_inputs);
  if (const StageTeam* team = outcome.team)
    text += fmt::format("  workers     {}, {} of {} levels of tasks shared\n", outcome.workers, team->shared(),
                        team->shared() + team->alone());
  text += to_text(outcome.verdict);
  return text;
}

nlohmann::ordered_json to_json(const RunOutcome& outcome) {
  const Graph& graph = outcome.graph();
  const Report& report = outcome.report;
  auto heaps = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < graph.tasks.size(); ++i)
    if (const PrivateHeap* heap = outcome.state.heaps[i])
      heaps[graph.tasks[i].name] = {{"size", heap->size()}, {"max_used", heap->max_used()}};
  nlohmann::ordered_json json{
      {"schema", "jarol.run/2"},
      {"graph", graph.name},
      {"clock", outcome.in_real_time() ? "real" : "virtual"},
      {"concurrency", outcome.threads != nullptr ? "threads" : "exotasks"},
      {"digest", fmt::format("0x{:016x}", report.digest)},
      {"digest_claimed", outcome.threads == nullptr && !has_weak_isolation(graph)},
      {"digest_notes", warnings(find_arithmetic())},
      {"simulated_ns", outcome.simulated.count()},
      {"wall_ns", static_cast<std::int64_t>(outcome.seconds * 1e9)},
      {"real_time_factor", real_time_factor(outcome)},
      {"activations", report.activations},
      {"instants", report.instants},
      {"faults", faults_to_json(report)},
      {"fault_count", report.fault_count},
      {"fault_summary", fault_summary_to_json(report)},
      {"non_finite_inputs", report.non_finite_inputs},
      {"ending", to_json(outcome.end)},
      {"rest", to_json(graph, outcome.rest, outcome.end)},
      {"failsafe", to_json(graph, outcome.failsafe)},
      {"events", to_json(outcome.noted.reported.kept())},
      {"logged", to_json(outcome.noted.logged.kept())},
      {"heaps", heaps},
      {"outputs", outputs_to_json(graph, [&](std::size_t communicator) { return outcome.last_value(communicator); })}};
  if (outcome.clock != nullptr) json["real_time"] = to_json(graph, *outcome.clock);
  if (outcome.threads != nullptr) json["real_time"] = to_json(graph, *outcome.threads);
  if (outcome.guard != nullptr) json["guardian"] = to_json(*outcome.guard);
  json["true_values"] = to_json(outcome.true_states);
  json["judgement"] = to_json(outcome.verdict);
  for (const LinkReport& link : outcome.links) json["links"].push_back(to_json(link));
  return json;
}

}  // namespace jarol::tools
