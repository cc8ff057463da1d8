#include "distributers/campaign/statement.h"

#include <algorithm>

#include "graph/campaign/columns.h"
#include "graph/campaign/random.h"
#include "graph/campaign/read.h"
#include "graph/campaign/variation.h"
#include "graph/language/override.h"

namespace jarol::campaign {
namespace {

constexpr std::size_t max_tried = 100;  // of a list

// Values that runs can have: those that were written, and one within a range.
std::vector<std::string> samples_of(const Variation& v) {
  const auto text = [&](double number) { return value_text(number, v.unit); };
  switch (v.kind) {
    case Variation::Kind::uniform:
      return {text(v.from), text(v.from + (v.to - v.from) * 0.3819660112501051), text(v.to)};
    case Variation::Kind::normal: return {text(v.from), text(v.from + v.to * normal_quantile(0.3819660112501051))};
    case Variation::Kind::list:
      return {v.values.begin(), v.values.begin() + static_cast<std::ptrdiff_t>(std::min(v.values.size(), max_tried))};
    case Variation::Kind::seeds: break;
  }
  return {};
}

// Each value by itself, all else as in the file.
void try_values(Graphs& graphs, const Variation& variation, Problems& problems) {
  if (variation.path == "seed") return;
  for (const std::string& value : samples_of(variation)) {
    Start start;
    start.set = {variation.path + "=" + value};
    try {
      graphs.of(start)->graph.start(changes_of(start, true), 0);
    } catch (const SpecError& error) {
      for (const Problem& problem : error.problems())
        problems.add(variation.where, "'" + variation.path + "' can't be " + value + ": " + problem.text);
      return;
    }
  }
}

// Each path and each metric has a column.
void require_own_columns(const Campaign& campaign, Problems& problems) {
  for (const Variation& v : campaign.vary) {
    for (const Variation& other : campaign.vary) {
      if (&other == &v) break;
      if (is_same_column(v.path, other.path))
        problems.add(v.where, "'" + v.path + "' differs from '" + other.path +
                                  "' in case alone, as no two columns of the results may; vary one of them");
    }
    for (const Metric& metric : campaign.measures.metrics)
      if (is_same_column(v.path, metric.name))
        problems.add(v.where, "'" + v.path + "' and metric '" + metric.name +
                                  "' would have one column of the results; give the metric another name");
  }
}

}  // namespace

Campaign state_campaign(Graphs& graphs, const Wishes& wishes) {
  Campaign campaign = graphs.base().graph.campaign();
  campaign.measures = graphs.base().measures;
  Problems problems;
  add_variations(campaign.vary, wishes.vary, problems);
  if (wishes.runs) campaign.runs = wishes.runs;
  if (wishes.sampling) campaign.sampling = *wishes.sampling;
  if (wishes.length) campaign.length = wishes.length;
  require_own_columns(campaign, problems);
  problems.throw_if_any();
  for (const Variation& variation : campaign.vary) try_values(graphs, variation, problems);
  problems.throw_if_any();
  return campaign;
}

}  // namespace jarol::campaign
