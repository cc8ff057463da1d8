#include "tools/commands/campaign/campaign_page.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "tools/drawing/pages/page.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;
using campaign::Result;
using campaign::Variation;

constexpr std::uint64_t max_points = 20'000;
constexpr std::size_t bins = 40;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// The numbers that a list begins its values with; empty: some of them begin with none, and stand side by side.
std::vector<double> numbers_of(const std::vector<std::string>& values) {
  std::vector<double> numbers;
  for (const std::string& value : values) {
    char* end = nullptr;
    numbers.push_back(std::strtod(value.c_str(), &end));
    const std::string unit = end;
    if (end == value.c_str() || unit.find_first_of("0123456789,[{") != std::string::npos) return {};
  }
  return numbers;
}

// Where a varied value stands on an axis.
class VariedAxis {
 public:
  explicit VariedAxis(const Variation& variation)
      : variation_(variation),
        numbers_(variation.kind == Variation::Kind::list ? numbers_of(variation.values) : std::vector<double>{}) {}

  Json json() const {
    const bool words = variation_.kind == Variation::Kind::list && numbers_.empty();
    return {{"path", variation_.path},
            {"text", variation_.text},
            {"unit", variation_.unit},
            {"words", words ? Json(variation_.values) : Json()}};
  }
  double at(const CampaignOutcome& outcome, std::size_t index, const campaign::Start& start) const {
    if (variation_.is_drawn()) return outcome.draws.number_at(index, start.index);
    if (variation_.kind == Variation::Kind::seeds) return static_cast<double>(start.seed);
    const auto value = std::find(variation_.values.begin(), variation_.values.end(), start.values[index]);
    const auto place = static_cast<std::size_t>(value - variation_.values.begin());
    if (place == variation_.values.size()) return nothing;
    return numbers_.empty() ? static_cast<double>(place) : numbers_[place];
  }

 private:
  const Variation& variation_;
  std::vector<double> numbers_;
};

// How many runs have which number, those that are good and others apart.
struct Histogram {
  double from = 0, width = 0;
  std::vector<std::uint64_t> good = std::vector<std::uint64_t>(bins), others = std::vector<std::uint64_t>(bins);

  void add(double number, bool is_good) {
    const double place = width > 0 ? (number - from) / width : 0;
    ++(is_good ? good : others)[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(bins - 1)))];
  }
  Json json() const { return {{"from", from}, {"width", width}, {"good", good}, {"others", others}}; }
};

// The numbers at which a limit is reached.
Json limits_json(const expect::Condition& condition, const campaign::Metric& metric) {
  using Kind = expect::Comparison::Kind;
  if (!metric.is_limit || condition.kind != expect::Condition::Kind::metric) return Json::array();
  const expect::Comparison& c = condition.comparison;
  switch (c.kind) {
    case Kind::less:
    case Kind::at_most:
    case Kind::greater:
    case Kind::at_least: return Json::array({c.limit});
    case Kind::within: return Json::array({c.of - c.limit, c.of + c.limit});
    case Kind::is:
    case Kind::is_not: return Json::array();
  }
  return Json::array();
}

}  // namespace

std::string campaign_page(const CampaignOutcome& outcome, const Json& report, const campaign::Results& results) {
  const campaign::Campaign& of = outcome.campaign;
  std::vector<VariedAxis> axes;
  Json vary = Json::array();
  for (const Variation& variation : of.vary) vary.push_back(axes.emplace_back(variation).json());
  std::vector<Histogram> histograms(outcome.summary.metrics.size());
  for (std::size_t i = 0; i < histograms.size(); ++i) {
    const campaign::MetricSummary& m = outcome.summary.metrics[i];
    if (m.min && m.max)
      histograms[i] = {.from = m.min->value, .width = (m.max->value - m.min->value) / static_cast<double>(bins)};
  }
  // those that stand out are always there
  std::set<std::uint64_t> named;
  for (const campaign::MetricSummary& m : outcome.summary.metrics)
    for (const auto& one : {m.min, m.max, m.worst})
      if (one) named.insert(one->index);
  for (const campaign::MetricSummary& m : outcome.summary.metrics)
    if (m.first_bad_without) named.insert(*m.first_bad_without);
  for (const Result& result : outcome.summary.not_good) named.insert(result.index);
  const std::uint64_t every = (outcome.summary.runs + max_points - 1) / max_points;
  std::vector<double> index, outcomes;
  std::vector<std::vector<double>> varied(axes.size()), reached(histograms.size());
  std::uint64_t seen = 0;
  const auto add = [&](const Result& result) {
    for (std::size_t i = 0; i < histograms.size() && i < result.metrics.size(); ++i)
      if (result.metrics[i].number)
        histograms[i].add(*result.metrics[i].number, result.outcome == campaign::Outcome::good);
    if (seen++ % every != 0 && !named.contains(result.index)) return;
    const campaign::Start start = outcome.draws.at(result.index);
    index.push_back(static_cast<double>(result.index));
    outcomes.push_back(static_cast<double>(result.outcome));
    for (std::size_t i = 0; i < axes.size(); ++i) varied[i].push_back(axes[i].at(outcome, i, start));
    for (std::size_t i = 0; i < reached.size(); ++i)
      reached[i].push_back(i < result.metrics.size() && result.metrics[i].number ? *result.metrics[i].number : nothing);
  };
  results.for_each(add, outcome.range());
  Json data{{"schema", "jarol.campaign_page/2"}, {"report", report}, {"every", every}, {"vary", std::move(vary)}};
  for (std::size_t i = 0; i < axes.size(); ++i) data["vary"][i]["values"] = base64_of(varied[i]);
  data["metrics"] = Json::array();
  for (std::size_t i = 0; i < reached.size(); ++i)
    data["metrics"].push_back({{"limits", limits_json(of.measures.conditions[i], of.measures.metrics[i])},
                               {"histogram", histograms[i].json()},
                               {"values", base64_of(reached[i])}});
  data["index"] = base64_of(index);
  data["outcomes"] = base64_of(outcomes);
  return page_of("Campaign of " + outcome.graph, {"base.js", "data.js", "summary.js", "distribution.js", "campaign.js"},
                 data);
}

}  // namespace jarol::tools
