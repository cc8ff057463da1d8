#include "graph/campaign/read.h"

#include <algorithm>
#include <map>
#include <memory>

#include "graph/campaign/columns.h"
#include "graph/campaign/variation.h"
#include "graph/expect/parse.h"
#include "graph/language/load.h"
#include "graph/language/override.h"

namespace jarol::campaign {
namespace {

// The names that options of a command line have given so far.
class GivenOnce {
 public:
  // False after a report: an option before it has given that name.
  bool add(const std::string& name, const std::string& subject, const Location& where, Problems& problems) {
    const auto [first, is_new] = places_.emplace(name, where);
    if (!is_new) problems.add(where, subject + " is given twice; keep one", {{first->second, "first here"}});
    return is_new;
  }

 private:
  std::map<std::string, Location> places_;
};

// "name=metric"; nothing after a report.
std::optional<std::pair<std::string, Yaml>> read_metric(const std::string& argument, Problems& problems) {
  const auto source = std::make_shared<Source>(Source{"--metric", argument});
  const std::size_t equals = argument.find('=');
  const std::string name = argument.substr(0, equals);
  if (equals == std::string::npos || !is_name(name)) {
    problems.add({source, 1, 1},
                 "'" + argument + "' names no metric; write name=metric, as in deepest=max(depth of dune)");
    return std::nullopt;
  }
  Yaml text;
  text.kind = Yaml::Kind::scalar;
  text.text = argument.substr(equals + 1);
  text.where = {source, 1, static_cast<int>(equals) + 2};
  return std::pair(name, text);
}

// In place of how the path varied.
void add_variation(std::vector<Variation>& vary, Variation variation) {
  const auto same =
      std::find_if(vary.begin(), vary.end(), [&](const Variation& v) { return v.path == variation.path; });
  if (same == vary.end())
    vary.push_back(std::move(variation));
  else
    *same = std::move(variation);
}

}  // namespace

void add_metric(Measures& measures, const std::string& name, const Location& where, const Yaml& text,
                const Graph& graph, const std::vector<expect::TrueValues>& vehicles, Problems& problems) {
  const std::string subject = "metric '" + name + "'";
  if (!is_name(name))
    return problems.add(where, subject + " has no good name; use letters, digits and _, no digit first");
  if (is_common_column(name))
    return problems.add(where, subject + " has the name of a column that all results have; choose another");
  for (const Metric& metric : measures.metrics)
    if (metric.name != name && is_same_column(metric.name, name))
      return problems.add(where, subject + " differs from metric '" + metric.name + "' in case alone; choose another");
  auto measured = expect::parse_measured(text, subject, graph, vehicles, problems);
  if (!measured) return;
  const auto same = std::find_if(measures.metrics.begin(), measures.metrics.end(),
                                 [&](const Metric& metric) { return metric.name == name; });
  const Metric metric{name, measured->is_limit, measured->is_instant};
  if (same == measures.metrics.end()) {
    measures.metrics.push_back(metric);
    measures.conditions.push_back(std::move(measured->condition));
  } else {
    measures.conditions[static_cast<std::size_t>(same - measures.metrics.begin())] = std::move(measured->condition);
    *same = metric;
  }
}

void add_metrics(Measures& measures, const std::vector<std::string>& arguments, const Graph& graph,
                 const std::vector<expect::TrueValues>& vehicles, Problems& problems) {
  GivenOnce given;
  for (const std::string& argument : arguments) {
    const auto metric = read_metric(argument, problems);
    if (!metric) continue;
    const auto& [name, text] = *metric;
    const Location where{text.where.source, 1, 1};
    if (given.add(name, "metric '" + name + "'", where, problems))
      add_metric(measures, name, where, text, graph, vehicles, problems);
  }
}

void add_variations(std::vector<Variation>& vary, const std::vector<std::string>& arguments, Problems& problems) {
  GivenOnce given;
  for (const std::string& argument : arguments) {
    std::optional<Variation> variation = read_variation(argument, problems);
    if (variation && given.add(variation->path, "'" + variation->path + "'", variation->where, problems))
      add_variation(vary, std::move(*variation));
  }
}

Campaign read_campaign(const std::optional<CampaignSpec>& spec, const Graph& graph,
                       const std::vector<expect::TrueValues>& vehicles, Problems& problems) {
  Campaign campaign;
  if (!spec) return campaign;
  if (spec->vary)
    for (const Yaml& child : spec->vary->value.children)
      if (auto variation = read_variation(child.key, child.key_where, child, problems))
        add_variation(campaign.vary, std::move(*variation));
  if (spec->runs) campaign.runs = spec->runs->value;
  if (spec->sampling) campaign.sampling = spec->sampling->value;
  if (spec->length) campaign.length = spec->length->value;
  if (spec->metrics)
    for (const Yaml& child : spec->metrics->value.children)
      add_metric(campaign.measures, child.key, child.key_where, child, graph, vehicles, problems);
  return campaign;
}

}  // namespace jarol::campaign
