#include "tools/commands/campaign/outputs.h"

#include <iostream>
#include <nlohmann/json.hpp>

#include "tools/commands/campaign/campaign_page.h"

namespace jarol::tools {

CampaignOutputs::CampaignOutputs(const std::string& table, const std::string& page) : table_to_stdout_(table == "-") {
  if (!table.empty() && !table_to_stdout_) table_.emplace(table);
  if (!page.empty()) page_.emplace(page);
}

void CampaignOutputs::write(const CampaignOutcome& outcome, const campaign::Results& results) {
  write_table(outcome, results);
  if (!page_) return;
  page_->write(campaign_page(outcome, to_json(outcome), results));
  page_->commit();
}

void CampaignOutputs::write_table(const CampaignOutcome& outcome, const campaign::Results& results) {
  if (!table_to_stdout_ && !table_) return;
  const auto write = [this](std::string_view text) {
    if (table_)
      table_->write(text);
    else
      std::cout << text;
  };
  write_csv(results, outcome.campaign, outcome.draws, write, outcome.range());
  if (table_) table_->commit();
}

}  // namespace jarol::tools
