// A run of a submarine's graph, with the submarine's true motion at every instant.
#pragma once

#include <string>
#include <vector>

#include "graph/language/load.h"
#include "runtime/execute/executor.h"
#include "tasks/values/alarm.h"
#include "tasks/values/lauv.h"

namespace jarol::test {

struct Sample {
  double time = 0;
  tasks::Motion motion;
};

struct Dive {
  std::vector<Sample> samples;
  Report report;
  tasks::Alarm alarm = tasks::Alarm::none;  // told last
  double alarmed_at = 0;
  tasks::FinCheck fins = tasks::FinCheck::checked;  // likewise
};

/// Runs "file" or "file:profile" with these overrides, "path=value", to the end of its mission or until `end`.
Dive dive(const std::string& file, const std::vector<std::string>& overrides = {}, std::uint64_t seed = 0,
          Duration end = {});

}  // namespace jarol::test
