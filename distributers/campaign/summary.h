// What the results of a campaign come to: how many runs are good, percentiles, and the worst cases.
#pragma once

#include <array>
#include <map>

#include "distributers/campaign/results.h"

namespace jarol::campaign {

/// A run that stands out by its number.
struct Case {
  std::uint64_t index = 0;
  double value = 0;
};

struct MetricSummary {
  std::string name;
  std::string unit;
  std::uint64_t count = 0;    // runs that have a number
  std::uint64_t missing = 0;  // runs that have no value
  /// Of those, the runs that came to their end and broke the limit by having no value, and the first of them.
  std::uint64_t bad_without = 0;
  std::optional<std::uint64_t> first_bad_without{};
  double mean = 0, deviation = 0;
  std::array<double, 5> percentiles{};           // 5, 25, 50, 75, 95: a number that a run has, by nearest rank
  std::optional<Case> min{}, max{};              // of all numbers
  std::optional<Case> worst{};                   // of all numbers, by its limit
  std::map<std::string, std::uint64_t> words{};  // of what is no number: runs that have each
};

struct Summary {
  std::uint64_t runs = 0;
  std::array<std::uint64_t, 5> outcomes{};  // by Outcome
  std::vector<MetricSummary> metrics;
  std::vector<Result> not_good;        // the first of them
  std::optional<Result> first_failed;  // the first that is not good and was not refused
  std::uint64_t not_judged = 0;        // good runs of which not all that is expected was judged
  std::optional<Result> first_not_judged;
  bool all_same = false;  // of several runs: one digest, one outcome, and the same of each metric
  std::uint64_t good() const { return outcomes[0]; }
};

inline constexpr std::array<int, 5> percents{5, 25, 50, 75, 95};
inline constexpr std::size_t max_not_good = 10;

/// Of all runs of the range that are in the results.
Summary summarise(const Results& results, const Measures& measures, const RunRange& range = {});

/// The results as a table, in the order of the index: a line for each run of the range that is there. `write` gets it
/// in pieces.
void write_csv(const Results& results, const Campaign& campaign, const Draws& draws,
               const std::function<void(std::string_view)>& write, const RunRange& range = {});

}  // namespace jarol::campaign
