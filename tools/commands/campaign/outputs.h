// The table and the page that a campaign is asked for: files that can be made are seen to before the first run, and
// what stood there before stays until they are whole.
#pragma once

#include <optional>
#include <string>

#include "distributers/campaign/summary.h"
#include "runtime/files/atomic_file.h"
#include "tools/commands/campaign/campaign_report.h"

namespace jarol::tools {

class CampaignOutputs {
 public:
  /// Names of files, and of the table "-" for stdout; empty: none. Throws std::system_error.
  CampaignOutputs(const std::string& table, const std::string& page);

  /// Once all runs of the outcome are there.
  void write(const CampaignOutcome& outcome, const campaign::Results& results);

 private:
  void write_table(const CampaignOutcome& outcome, const campaign::Results& results);

  bool table_to_stdout_;
  std::optional<AtomicFile> table_, page_;
};

}  // namespace jarol::tools
