#include "distributers/session/verdict.h"

#include <fmt/format.h>

#include <algorithm>

#include "distributers/session/rest_verdict.h"

namespace jarol {
namespace {

// A share of few activations says nothing: one fault, with the release that it skips, is not held against a task that
// gave something, unless the graph allows none.
bool is_single(const Task& task, std::uint64_t left_out, std::int64_t due) {
  return left_out <= (task.on_fault == OnFault::skip ? 2U : 1U) && left_out < static_cast<std::uint64_t>(due);
}

}  // namespace

bool RunVerdict::is_negative() const {
  return !stopped.empty() || !unseen.empty() || !mishaps.empty() || !left_out.empty() || !not_at_rest.empty() ||
         std::any_of(expectations.begin(), expectations.end(),
                     [](const Verdict& v) { return v.outcome == Verdict::Outcome::fails; });
}

std::string to_text(const RunVerdict::VehicleMishap& mishap) {
  return "the vehicle of '" + mishap.distributer + "' has " + mishap.text;
}

std::vector<RunVerdict::VehicleMishap> find_mishaps(const Graph& graph, const std::vector<ExternalSystem*>& systems,
                                                    const std::optional<RestReport>& rest) {
  std::vector<RunVerdict::VehicleMishap> found;
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const std::string& name = graph.distributers[i].name;
    if (std::string mishap = systems[i]->mishap(); !mishap.empty()) found.push_back({name, std::move(mishap)});
    if (!rest || !rest->reached) continue;
    if (const std::string unrest = systems[i]->unrest(); !unrest.empty())
      found.push_back({name, "not come to rest: " + unrest});
  }
  return found;
}

void show_mishaps_and_close(RunSinks& sinks, const Graph& graph, const std::vector<ExternalSystem*>& systems,
                            const Report& report, const std::optional<RestReport>& rest) {
  for (const RunVerdict::VehicleMishap& mishap : find_mishaps(graph, systems, rest))
    sinks.show({.kind = RunEvent::Kind::mishap,
                .instant = report.simulated,
                .cause = mishap.text,
                .distributer = mishap.distributer});
  sinks.close();
}

std::vector<std::string> find_unheard(const Graph& graph, const std::vector<ExternalSystem*>& systems) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const auto takes = [i](const Communicator& c) { return c.distributer == i && c.direction == Direction::in; };
    if (!graph.distributers[i].distributer_class->is_vehicle ||
        std::none_of(graph.communicators.begin(), graph.communicators.end(), takes))
      continue;
    const std::optional<LinkReport> link = systems[i]->link_report();
    if (link && link->heard == 0) found.push_back(graph.distributers[i].name);
  }
  return found;
}

std::string why_cut_short(Duration reached, Duration until, Duration mission) {
  const std::string ended = "the run ended at " + seconds_text(reached) + " s";
  if (reached < until && until != Duration::max())
    return ended + ", and was to go on until " + seconds_text(until) + " s";
  if (reached < mission) return ended + ", its mission ends at " + seconds_text(mission) + " s";
  return "";
}

Duration end_of_mission(const std::vector<ExternalSystem*>& systems) {
  Duration end{};
  for (const ExternalSystem* each : systems) end = std::max(end, each->end().value_or(Duration{}));
  return end;
}

std::vector<std::string> find_left_out(const Graph& graph, const Report& report) {
  std::vector<std::string> lines;
  if (report.stopped) return lines;  // the fault that ended the run says it all
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Task& task = graph.tasks[i];
    const std::int64_t after_first = (report.covered - task.offset).count() - 1;
    if (report.left_out[i] == 0 || after_first < 0) continue;
    const std::int64_t due = after_first / task.period.count() + 1;
    const double share = static_cast<double>(report.left_out[i]) / static_cast<double>(due);
    if (share <= graph.fault_limit) continue;
    if (graph.fault_limit > 0 && is_single(task, report.left_out[i], due)) continue;
    lines.push_back(
        fmt::format("task '{}' gave nothing in {} of {} activations, {:.1f} %, above the fault limit of {:g} %",
                    task.name, report.left_out[i], due, 100 * share, 100 * graph.fault_limit));
  }
  return lines;
}

RunVerdict judge_run(const Graph& graph, const Report& report, const std::vector<ExternalSystem*>& systems,
                     const RunSinks& sinks, const std::optional<RestReport>& rest, Duration until, const RunEnd& end) {
  RunVerdict verdict;
  const std::optional<Duration> rest_begun = rest ? std::optional(rest->begun) : std::nullopt;
  if (!end.hangs) {
    std::string cut_short =
        why_cut_short(judged_until(rest_begun, until, report.simulated), until, end_of_mission(systems));
    // of a session that went back to where it was stopped it is not known how far it was to go
    if (cut_short.empty() && report.stopped)
      cut_short = "a fault ended the run at " + seconds_text(report.simulated) + " s";
    verdict.expectations = sinks.judge(judged_until(rest_begun, until, report.covered), cut_short);
    verdict.mishaps = find_mishaps(graph, systems, rest);
  }
  verdict.not_at_rest = not_at_rest_text(graph, rest, end);
  verdict.left_out = find_left_out(graph, report);
  if (report.instants > 0) verdict.unheard = find_unheard(graph, systems);
  return verdict;
}

}  // namespace jarol
