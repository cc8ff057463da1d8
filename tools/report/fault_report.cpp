#include "tools/report/fault_report.h"

#include <nlohmann/json.hpp>

#include "graph/text/escape.h"
#include "runtime/run/fault_text.h"

namespace jarol::tools {
namespace {

bool is_of_time(const Fault& fault) { return fault.cause == overrun_text || fault.cause.starts_with("late: "); }

}  // namespace

std::string fault_report(const Report& report) {
  std::string text;
  for (const FaultGroup& group : report.fault_summary.groups()) {
    const Fault& first = group.first;
    if (group.count == 1) {
      text += "fault: " + printable(to_text(first)) + "\n";
      continue;
    }
    text += "fault: task '" + first.task + "' " + std::to_string(group.count) + " times, from activation " +
            std::to_string(first.activation) + " at " + seconds_text(first.instant) + " s to activation " +
            std::to_string(group.last_activation) + " at " + seconds_text(group.last_instant) +
            " s: " + printable(first.cause) + "\n";
  }
  if (const std::uint64_t others = report.fault_summary.others(); others > 0)
    text += "fault: and " + std::to_string(others) + " of other causes\n";
  if (report.stopped && !report.faults.empty() && is_of_time(report.faults.back()) &&
      !is_by_limit(report.faults.back()))
    text +=
        "note: 'on_fault: stop', the default, ended the run there; with 'hold' what is late keeps its last outputs and "
        "the run goes on, as with --set tasks." +
        printable(report.faults.back().task) + ".on_fault=hold\n";
  return text;
}

nlohmann::ordered_json fault_summary_to_json(const Report& report) {
  auto groups = nlohmann::ordered_json::array();
  for (const FaultGroup& group : report.fault_summary.groups())
    groups.push_back({{"task", group.first.task},
                      {"cause", group.first.cause},
                      {"count", group.count},
                      {"first_instant_ns", group.first.instant.count()},
                      {"last_instant_ns", group.last_instant.count()}});
  return groups;
}

nlohmann::ordered_json faults_to_json(const Report& report) {
  auto faults = nlohmann::ordered_json::array();
  for (const Fault& f : report.faults)
    faults.push_back(
        {{"task", f.task}, {"activation", f.activation}, {"instant_ns", f.instant.count()}, {"cause", f.cause}});
  return faults;
}

}  // namespace jarol::tools
