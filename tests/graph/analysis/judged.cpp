#include "tests/graph/analysis/judged.h"

#include <algorithm>

namespace jarol::truth {
namespace {

using analysis::Verdict;
using Answer = Truth::Answer;

constexpr std::size_t max_states = 100'000;

bool keeps_given_cores(const Set& set, const std::vector<std::size_t>& core) {
  for (std::size_t i = 0; i < core.size(); ++i)
    if (set.tasks[i].core && static_cast<std::size_t>(*set.tasks[i].core) != core[i]) return false;
  return true;
}

}  // namespace

Truth truth_on_best_cores(const Set& set, const Places& places) {
  std::vector<std::size_t> core(set.tasks.size(), 0);
  if (set.policy == policies::global_edf) return truth_of(set, core, places, max_states);
  Truth last;
  bool open = false;
  while (true) {
    if (keeps_given_cores(set, core)) {
      last = truth_of(set, core, places, max_states);
      if (last.answer == Answer::schedulable) return last;
      open = open || last.answer == Answer::too_large;
    }
    std::size_t i = 0;
    while (i < core.size() && ++core[i] == static_cast<std::size_t>(set.cores)) core[i++] = 0;
    if (i == core.size()) break;
  }
  if (open) last.answer = Answer::too_large;
  return last;
}

Judged judge(const Set& set) {
  const Graph graph = graph_of(set);
  Judged judged{set, analysis::check(graph), {}};
  std::vector<std::size_t> core;
  for (const auto& c : judged.said.core) core.push_back(c.value_or(0));
  judged.truth = judged.says(Verdict::schedulable) ? truth_of(set, core, places_in(graph), max_states)
                                                   : truth_on_best_cores(set, places_in(graph));
  return judged;
}

std::string Judged::wrong() const {
  if (says(Verdict::schedulable) && truth.answer == Answer::late) return "unsafe yes";
  if (truth.answer != Answer::schedulable) return "";
  if (says(Verdict::not_schedulable)) return said.evidence == analysis::Evidence::proof ? "false proof" : "";
  if (says(Verdict::unknown)) return "";
  for (std::size_t i = 0; i < set.tasks.size(); ++i)
    if (said.response[i] && *said.response[i] < Duration(truth.longest[i])) return "short response";
  for (std::size_t i = 0; i < set.tasks.size(); ++i)
    if (said.response[i] && said.exact[i] && *said.response[i] > Duration(truth.longest[i]))
      return "response that is not reached";
  return "";
}

std::string Judged::text() const {
  std::string text = yaml_of(set, "ms") + "said: " + said.reason + "; responses";
  for (std::size_t i = 0; i < said.response.size(); ++i)
    text += (said.exact[i] ? " " : " <=") + (said.response[i] ? std::to_string(said.response[i]->count()) : "-");
  text += ", cores";
  for (const auto& c : said.core) text += " " + (c ? std::to_string(*c) : "-");
  text += truth.answer == Answer::late ? "\ntrue: late\n" + truth.witness : "\ntrue: schedulable, longest responses";
  if (truth.answer == Answer::schedulable)
    for (const int response : truth.longest) text += " " + std::to_string(response);
  return text;
}

}  // namespace jarol::truth
