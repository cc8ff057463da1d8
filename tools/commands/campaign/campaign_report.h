// What a campaign reports at its end.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "distributers/campaign/run_all.h"
#include "distributers/campaign/shrink.h"
#include "distributers/campaign/summary.h"

namespace jarol::tools {

struct CampaignOutcome {
  const std::string& graph;  // its name
  const campaign::Campaign& campaign;
  const campaign::Draws& draws;
  const campaign::Summary& summary;
  std::optional<campaign::Shard> shard{};                // what the summary is of; none: all runs
  std::function<std::string(std::uint64_t run)> repeat;  // the command that does
  std::string results;                                   // the file
  std::uint64_t ran = 0;                                 // just now; others were there before
  double seconds = 0;                                    // that they took
  const campaign::Shrunk* shrunk = nullptr;              // of the first run that failed; null: not asked for, or none
  bool all_refused = false;                              // what was to be shrunk: all runs that are not good
  std::string repeat_shrunk{};                           // the command that repeats the mildest run

  campaign::RunRange range() const { return shard.value_or(campaign::Shard()).of(draws.runs()); }
};

std::string to_text(const CampaignOutcome& outcome);
nlohmann::ordered_json to_json(const CampaignOutcome& outcome);

/// "1:05", "2:03:04": of seconds.
std::string clock_text(double seconds);

}  // namespace jarol::tools
