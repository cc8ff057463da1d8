// Scheduling policies that a plugin brings: JAROL_PLUGIN(..., RateMonotonic) where
//
//   struct RateMonotonic {
//     static constexpr std::string_view name = "rate_monotonic", how = "the task with the shortest period runs";
//     static constexpr jarol::Urgency urgency = jarol::Urgency::priority;
//     static constexpr bool interrupts = true;
//     static Result check(const System& system, bool whole, Budget& budget);
//   };
//
// with the names of jarol::analysis. `jarol check` judges by it; what runs when, in pictures and under --execution,
// follows from `urgency` and `interrupts`; the real clock does not execute it. graph/analysis/own_policy.md has one.
#pragma once

#include "graph/analysis/check.h"
#include "graph/plugins/plugin.h"

namespace jarol {

template <analysis::PolicyForm P>
struct PluginPart<P> {
  static void add(PluginParts& parts) { parts.graph.add(analysis::make_policy<P>()); }
};

}  // namespace jarol
