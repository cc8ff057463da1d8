// What came of a campaign as a page for people: one HTML file.
#pragma once

#include "tools/commands/campaign/campaign_report.h"

namespace jarol::tools {

/// `report`: to_json of the outcome. Of very many runs the page's scatter plots have one in so many, and those that the
/// report names; its histograms count all.
std::string campaign_page(const CampaignOutcome& outcome, const nlohmann::ordered_json& report,
                          const campaign::Results& results);

}  // namespace jarol::tools
