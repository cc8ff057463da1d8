#include "tools/commands/run/print_run.h"

#include <fmt/format.h>
#include <iostream>
#include <nlohmann/json.hpp>

#include "graph/text/escape.h"
#include "tools/commands/run/execution.h"
#include "tools/report/duration_option.h"
#include "tools/report/fault_report.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

std::string saves_text(const std::vector<Save>& saves) {
  std::string text;
  for (const Save& save : saves) text += "  saved       at " + seconds_text(save.at) + " s to " + save.file + "\n";
  return text;
}

nlohmann::ordered_json json_of(const RunArguments& options, const RunOutcome& outcome, const std::vector<Save>& saves,
                               const WhatIfs& what_ifs) {
  auto json = to_json(outcome);
  if (!options.execution.empty()) json["execution"] = options.execution;
  if (options.guard) json["guard"] = true;
  if (outcome.begun > Duration{}) json["resumed_ns"] = outcome.begun.count();
  for (const Save& save : saves) json["saved"].push_back({{"instant_ns", save.at.count()}, {"file", save.file}});
  if (!what_ifs.outcomes().empty()) json["what_if"] = to_json(what_ifs.outcomes());
  return json;
}

}  // namespace

void print(const RunArguments& options, const RunOutcome& outcome, const std::vector<Save>& saves,
           const WhatIfs& what_ifs, bool written) {
  const Report& report = outcome.report;
  if (options.json) {
    std::cout << json_line(json_of(options, outcome, saves, what_ifs));
    return;
  }
  if (outcome.in_real_time()) {
    std::cout << fmt::format("{}: {} s in real time{}{}\n", printable(outcome.graph().name),
                             seconds_text(outcome.simulated), outcome.threads != nullptr ? " on threads" : "",
                             suffix_of(outcome.end));
  } else {
    const std::string from = outcome.begun > Duration{} ? ", from " + seconds_text(outcome.begun) + " s on," : "";
    std::cout << fmt::format("{}: {} s on the virtual clock{} in {:.2f} s, {:.0f} times real time{}\n",
                             printable(outcome.graph().name), seconds_text(outcome.simulated), from, outcome.seconds,
                             real_time_factor(outcome), suffix_of(outcome.end));
  }
  std::cout << to_text(outcome) << execution_text(options.execution, outcome.graph())
            << (options.guard ? "  guard       no task wrote to memory that is not its own\n" : "");
  std::cout << saves_text(saves);
  if (written) std::cout << to_text(options.files);
  if (written) std::cout << to_text(options.recording);
  std::cout << to_text(column_of(outcome.state, outcome.report, outcome.true_states, outcome.verdict),
                       what_ifs.outcomes());
  std::cerr << fault_report(report);
}

}  // namespace jarol::tools
