// The verdict on one core, by the policy's own test.
#pragma once

#include <string>

#include "graph/analysis/edf.h"
#include "graph/analysis/simulate.h"
#include "graph/analysis/system.h"

namespace jarol::analysis {

struct CoreResult {
  Verdict verdict = Verdict::unknown;
  Standing standing = Standing::none;
  std::string reason;
  std::vector<std::optional<std::int64_t>> responses;  // per load; upper bounds
  std::optional<Demand> demand;                        // why not, under EDF
  std::optional<Late> late;                            // why not
  std::vector<Slice> slices;                           // before that
};

/// Loads are most urgent first. Not for tables.
CoreResult check_core(std::span<const Load> loads, Policy policy, bool offsets_hold);

/// The verdict alone, without witness and responses; unknown where it would take more effort.
Verdict verdict_of_core(std::span<const Load> loads, Policy policy, bool offsets_hold, Effort& effort);

}  // namespace jarol::analysis
