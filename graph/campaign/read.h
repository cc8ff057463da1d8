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

/// "name=max(depth of dune)" as it came from the command line.
void add_metric(Measures& measures, const std::string& argument, const Graph& graph,
                const std::vector<expect::TrueValues>& vehicles, Problems& problems);

/// Adds how a path varies, in place of how it did.
void add_variation(std::vector<Variation>& vary, Variation variation);

}  // namespace jarol::campaign
