// What came of one run of a campaign.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/language/quantities.h"

namespace jarol::campaign {

/// good: to its end, as the graph expects and within all limits. bad: to its end, and not so. fault: a fault stopped
/// it. lost: an external system was lost. refused: there is no such run, as with a vehicle that can't be made.
enum class Outcome { good, bad, fault, lost, refused };

/// What a metric came to; neither: nothing, as of a run that did not come to its end.
struct Reached {
  std::optional<double> number{};
  std::string word{};  // of what is no number

  friend bool operator==(const Reached&, const Reached&) = default;
};

/// Something that is against a run.
struct Failure {
  std::string what;     // a metric, a condition, a task, a vehicle
  std::string cause{};  // of a fault or mishap
  std::string why;      // all of that in words

  friend bool operator==(const Failure&, const Failure&) = default;
};

struct Result {
  std::uint64_t index = 0;
  Outcome outcome = Outcome::good;
  std::string why{};  // of all but good; of a good one, why not all that is expected was judged
  Duration simulated{};
  std::uint64_t faults = 0;
  std::optional<std::uint64_t> digest{};  // none: it never began
  std::vector<Reached> metrics{};         // of those that the campaign measures
  std::uint64_t not_judged = 0;           // conditions of what is expected
  std::vector<Failure> failures{};        // all, the first is `why`; the results keep none

  friend bool operator==(const Result&, const Result&) = default;
};

/// "good", "bad", "fault", "lost", "refused".
const char* word_of(Outcome outcome);
std::optional<Outcome> outcome_of(const std::string& word);

}  // namespace jarol::campaign
