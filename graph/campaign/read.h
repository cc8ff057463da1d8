// The key `campaign` of a graph: from what the file says to what it means.
#pragma once

#include "graph/campaign/campaign.h"
#include "graph/expect/names.h"

namespace jarol::campaign {

/// Of a graph without the key: nothing varies, nothing is measured. What is wrong goes to `problems`.
Campaign read_campaign(const std::optional<CampaignSpec>& spec, const Graph& graph,
                       const std::vector<expect::TrueValues>& vehicles, Problems& problems);

/// Adds what is measured under that name, in place of what was.
void add_metric(Measures& measures, const std::string& name, const Location& where, const Yaml& text,
                const Graph& graph, const std::vector<expect::TrueValues>& vehicles, Problems& problems);

/// Those of a command line, "name=max(depth of dune)", each in place of what the file measures under its name.
void add_metrics(Measures& measures, const std::vector<std::string>& arguments, const Graph& graph,
                 const std::vector<expect::TrueValues>& vehicles, Problems& problems);

/// Those of a command line, "path=0.3..0.6", each in place of how the file varies its path.
void add_variations(std::vector<Variation>& vary, const std::vector<std::string>& arguments, Problems& problems);

}  // namespace jarol::campaign
