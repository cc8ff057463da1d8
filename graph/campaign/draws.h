// What each run of a campaign starts with: a function of the campaign's seed and the run's index alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graph/campaign/campaign.h"

namespace jarol::campaign {

/// A run's values, beside the campaign's own overrides.
struct Start {
  std::uint64_t index = 0;
  std::vector<std::string> values;  // per variation, as text; of the seed its number
  std::vector<std::string> set;     // "path=value", of all but the seed
  std::uint64_t seed = 0;
};

class Draws {
 public:
  /// `seed` is that of the draws, and of each run where the seed is not varied. The campaign outlives it.
  Draws(const Campaign& campaign, std::uint64_t seed);

  std::uint64_t runs() const { return runs_; }
  /// Of the run with that index, from 0.
  Start at(std::uint64_t index) const;
  /// The number that a run draws of a variation, before it is text; in the unit that is written there.
  double number_at(std::size_t variation, std::uint64_t index) const;

 private:
  double part(std::size_t variation, std::uint64_t index) const;

  const Campaign& campaign_;
  std::uint64_t seed_;
  std::uint64_t runs_;
  std::vector<std::uint64_t> every_;                // per variation that is crossed: runs between two of its values
  std::vector<std::vector<std::uint32_t>> strata_;  // per variation: of each run, where sampling is latin
};

/// Why the campaign has no number of runs, or can't have that one; empty: it has.
std::string wrong_runs(const Campaign& campaign);

/// The combinations of all that is crossed; none: more than `max_runs`.
std::optional<std::uint64_t> combinations(const Campaign& campaign);

}  // namespace jarol::campaign
