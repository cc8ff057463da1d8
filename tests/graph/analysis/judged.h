// What `check` says of a small set, beside what is true of it.
#pragma once

#include "graph/analysis/check.h"
#include "tests/graph/analysis/random_sets.h"

namespace jarol::truth {

struct Judged {
  Set set;
  analysis::Result said;
  Truth truth;  // on the cores that `check` assigned, if it says yes; else on the best there are
  bool decidable() const { return truth.answer != Truth::Answer::too_large; }
  bool says(analysis::Verdict verdict) const { return said.verdict == verdict; }

  /// "unsafe yes", "false proof", "short response" or "response that is not reached" (of a yes), or nothing.
  std::string wrong() const;
  /// The graph, what is said, what is true, and how a late activation comes about.
  std::string text() const;
};

Judged judge(const Set& set);

/// Is there an assignment of the tasks without a core that holds?
Truth truth_on_best_cores(const Set& set, const Places& places);

}  // namespace jarol::truth
