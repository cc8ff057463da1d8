#include "tools/commands/campaign/campaign_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "graph/text/escape.h"

namespace jarol::tools {
namespace {

using campaign::Case;
using campaign::MetricSummary;
using campaign::Outcome;
using campaign::Summary;
using Json = nlohmann::ordered_json;

std::string measured_text(double number, const std::string& unit) {
  if (unit == "rad") return fmt::format("{:.5g} deg", number * 180.0 / std::numbers::pi);
  return fmt::format("{:.5g}{}{}", number, unit.empty() ? "" : " ", unit);
}

std::string outcomes_text(const Summary& summary) {
  std::string text;
  for (std::size_t i = 0; i < summary.outcomes.size(); ++i)
    if (summary.outcomes[i] > 0 || i == 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", summary.outcomes[i],
                          campaign::word_of(static_cast<Outcome>(i)));
  return text;
}

// Of how many runs the numbers are.
std::string valued_text(const MetricSummary& m, std::uint64_t runs) {
  const std::uint64_t valued = runs - m.missing;
  if (valued == 0) return fmt::format("has no value in any of {} runs", runs);
  return fmt::format("has a value in {} of {} runs{}", valued, runs, m.count > 0 ? "; these numbers are of those" : "");
}

std::string table_of(const Summary& summary) {
  if (summary.metrics.empty() || summary.runs == 0) return "";
  std::size_t width = 6;
  for (const MetricSummary& m : summary.metrics) width = std::max(width, m.name.size());
  std::string text = fmt::format("  {:<{}}  {:>12}  {:>12}  {:>12}  {:>12}  {:>12}\n", "metric", width, "min", "5 %",
                                 "median", "95 %", "max");
  for (const MetricSummary& m : summary.metrics) {
    if (m.count > 0)
      text += fmt::format("  {:<{}}  {:>12}  {:>12}  {:>12}  {:>12}  {:>12}\n", m.name, width,
                          measured_text(m.min->value, m.unit), measured_text(m.percentiles[0], m.unit),
                          measured_text(m.percentiles[2], m.unit), measured_text(m.percentiles[4], m.unit),
                          measured_text(m.max->value, m.unit));
    for (const auto& [word, count] : m.words)
      text += fmt::format("  {:<{}}  {}: {} runs\n", m.name, width, word, count);
    if (m.missing > 0) text += fmt::format("  {:<{}}  {}\n", m.name, width, valued_text(m, summary.runs));
  }
  return text;
}

// By its limit where it has one, else both ends.
std::vector<std::pair<std::string, Case>> cases_of(const MetricSummary& m) {
  if (m.worst) return {{m.bad_without > 0 ? "worst value of" : "worst", *m.worst}};
  std::vector<std::pair<std::string, Case>> cases;
  if (m.min) cases.emplace_back("min", *m.min);
  if (m.max) cases.emplace_back("max", *m.max);
  return cases;
}

Json to_json(const Case& one, const CampaignOutcome& outcome) {
  return {{"run", one.index}, {"value", one.value}, {"command", outcome.repeat(one.index)}};
}

Json to_json(const MetricSummary& m, const expect::Condition& condition, bool is_limit,
             const CampaignOutcome& outcome) {
  Json json{{"name", m.name}, {"text", condition.text}, {"limit", is_limit},
            {"unit", m.unit}, {"runs", m.count},        {"missing", m.missing}};
  if (!m.words.empty()) json["words"] = m.words;
  if (m.first_bad_without)
    json["bad_without"] = {
        {"runs", m.bad_without}, {"run", *m.first_bad_without}, {"command", outcome.repeat(*m.first_bad_without)}};
  if (m.count == 0) return json;
  json["mean"] = m.mean;
  json["deviation"] = m.deviation;
  for (std::size_t i = 0; i < campaign::percents.size(); ++i)
    json["percentiles"][std::to_string(campaign::percents[i])] = m.percentiles[i];
  if (m.min) json["min"] = to_json(*m.min, outcome);
  if (m.max) json["max"] = to_json(*m.max, outcome);
  if (m.worst) json["worst"] = to_json(*m.worst, outcome);
  return json;
}

std::string cases_text(const MetricSummary& m, const CampaignOutcome& outcome) {
  std::string text;
  for (const auto& [word, one] : cases_of(m))
    text += fmt::format("  {} {}: {} in run {}\n    {}\n", word, m.name, measured_text(one.value, m.unit), one.index,
                        printable(outcome.repeat(one.index)));
  if (m.first_bad_without)
    text += fmt::format("  bad without a value of {}: run {}{}\n    {}\n", m.name, *m.first_bad_without,
                        m.bad_without > 1 ? fmt::format(", the first of {} such runs", m.bad_without) : "",
                        printable(outcome.repeat(*m.first_bad_without)));
  return text;
}

// "exolauv", "exolauv, shard 2/3 (runs 4 to 7)"
std::string title_of(const CampaignOutcome& outcome) {
  std::string text = printable(outcome.graph);
  if (!outcome.shard) return text;
  const campaign::RunRange range = outcome.range();
  text += fmt::format(", shard {}/{} ", outcome.shard->index + 1, outcome.shard->count);
  if (range.size() == 0) return text + "(no runs)";
  return text + (range.size() == 1 ? fmt::format("(run {})", range.begin)
                                   : fmt::format("(runs {} to {})", range.begin, range.end - 1));
}

// Where all runs are the same, and where good ones say less than it seems.
std::string notes_of(const Summary& summary) {
  std::string text;
  if (summary.all_same) text += fmt::format("  all {} runs have one digest: what varies has no effect\n", summary.runs);
  if (summary.first_not_judged)
    text += fmt::format("  run {} is good as far as it was judged{}: {}\n", summary.first_not_judged->index,
                        summary.not_judged > 1 ? fmt::format(", the first of {} such runs", summary.not_judged) : "",
                        printable(summary.first_not_judged->why));
  return text;
}

std::string shrunk_text(const CampaignOutcome& outcome) {
  if (outcome.all_refused) return "  no mildest values: all runs that are not good were refused\n";
  if (outcome.shrunk == nullptr) return "";
  const campaign::Shrunk& shrunk = *outcome.shrunk;
  const std::string what = shrunk.at_the_middle
                               ? fmt::format("run {} fails with each value at its mildest, too", shrunk.start.index)
                               : fmt::format("mildest values with which run {} still fails, by {} more runs",
                                             shrunk.start.index, shrunk.tried);
  return fmt::format("  {}: {}\n    {}\n", what, printable(shrunk.result.why), printable(outcome.repeat_shrunk));
}

Json shrunk_json(const CampaignOutcome& outcome) {
  if (outcome.all_refused) return nullptr;
  const campaign::Shrunk& shrunk = *outcome.shrunk;
  return {{"run", shrunk.start.index},
          {"outcome", campaign::word_of(shrunk.result.outcome)},
          {"why", shrunk.result.why},
          {"set", shrunk.start.set},
          {"seed", shrunk.start.seed},
          {"tried", shrunk.tried},
          {"at_the_middle", shrunk.at_the_middle},
          {"command", outcome.repeat_shrunk}};
}

}  // namespace

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(std::min(seconds, 1e9)));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string to_text(const CampaignOutcome& outcome) {
  const Summary& summary = outcome.summary;
  std::string text = fmt::format("{}: {} of {} runs, {}", title_of(outcome), summary.runs, outcome.range().size(),
                                 outcomes_text(summary));
  if (outcome.ran > 0) text += fmt::format("; {} of them in {:.1f} s", outcome.ran, outcome.seconds);
  text += "\n" + notes_of(summary) + table_of(summary);
  for (const MetricSummary& m : summary.metrics) text += cases_text(m, outcome);
  for (const campaign::Result& result : summary.not_good)
    text += fmt::format("  run {} is {}: {}\n    {}\n", result.index, campaign::word_of(result.outcome),
                        printable(result.why), printable(outcome.repeat(result.index)));
  if (const std::uint64_t not_good = summary.runs - summary.good(); not_good > summary.not_good.size())
    text += fmt::format("  and {} more runs that are not good, see {}\n", not_good - summary.not_good.size(),
                        printable(outcome.results));
  return text + shrunk_text(outcome) + "  results     " + printable(outcome.results) + "\n";
}

Json to_json(const CampaignOutcome& outcome) {
  const Summary& summary = outcome.summary;
  Json outcomes, metrics = Json::array(), not_good = Json::array();
  for (std::size_t i = 0; i < summary.outcomes.size(); ++i)
    outcomes[campaign::word_of(static_cast<Outcome>(i))] = summary.outcomes[i];
  const campaign::Measures& measures = outcome.campaign.measures;
  for (std::size_t i = 0; i < summary.metrics.size(); ++i)
    metrics.push_back(to_json(summary.metrics[i], measures.conditions[i], measures.metrics[i].is_limit, outcome));
  for (const campaign::Result& result : summary.not_good)
    not_good.push_back({{"run", result.index},
                        {"outcome", campaign::word_of(result.outcome)},
                        {"why", result.why},
                        {"command", outcome.repeat(result.index)}});
  Json json{{"schema", "jarol.campaign/2"}, {"graph", outcome.graph},
            {"runs", outcome.draws.runs()}, {"done", summary.runs},
            {"ran", outcome.ran},           {"wall_ns", static_cast<std::int64_t>(outcome.seconds * 1e9)},
            {"outcomes", outcomes},         {"metrics", metrics},
            {"not_good", not_good},         {"results", outcome.results}};
  if (summary.all_same) json["all_same"] = true;
  if (summary.first_not_judged)
    json["not_judged"] = {
        {"runs", summary.not_judged}, {"run", summary.first_not_judged->index}, {"why", summary.first_not_judged->why}};
  if (outcome.shard)
    json["shard"] = {{"part", outcome.shard->index + 1},
                     {"of", outcome.shard->count},
                     {"first", outcome.range().begin},
                     {"runs", outcome.range().size()}};
  if (outcome.shrunk != nullptr || outcome.all_refused) json["shrunk"] = shrunk_json(outcome);
  return json;
}

}  // namespace jarol::tools
