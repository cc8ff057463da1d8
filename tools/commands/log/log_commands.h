// What `jarol log` does with recordings; each prints, and returns an exit code.
#pragma once

#include <string>

#include "runtime/plan/output.h"

namespace jarol::tools {

struct LogOptions {
  std::string file, other;  // two of `diff`; of `trace` and `report` a graph in place of the recording's
  std::string topics;       // patterns; empty: all
  Duration from{}, until = Duration::max();
  std::string by_rate;  // a folder
  std::string out;      // a file
  bool common = false;  // of `diff`: topics that both have alone
  bool json = false;
};

int log_info(const LogOptions& options);
int log_cat(const LogOptions& options);
int log_csv(const LogOptions& options);
int log_verify(const LogOptions& options);
int log_diff(const LogOptions& options);
int log_trace(const LogOptions& options);
int log_report(const LogOptions& options);

}  // namespace jarol::tools
