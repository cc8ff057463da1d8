// What a campaign is: a graph run many times, with other values and seeds each time, and what is measured of each run.
// specs/campaigns.md has the language.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graph/language/spec.h"
#include "graph/model/condition.h"

namespace jarol::campaign {

/// How the value of a path goes from run to run. Lists are crossed: all their combinations come in turn, the last one
/// of a campaign goes fastest; of ranges and normal distributions each run has a draw of its own.
struct Variation {
  enum class Kind { uniform, normal, list, seeds };

  std::string path;  // as of --set, or "seed"
  Location where;
  std::string text;  // as it was written
  Kind kind = Kind::list;
  double from = 0, to = 0;             // uniform: both ends; normal: mean and standard deviation
  std::string unit;                    // behind those numbers
  std::vector<std::string> values;     // list
  std::uint64_t first = 0, count = 0;  // seeds

  bool is_drawn() const { return kind == Kind::uniform || kind == Kind::normal; }
  /// Of what is crossed: how many values it has.
  std::uint64_t size() const { return kind == Kind::seeds ? count : values.size(); }
};

/// A number or a word of each run.
struct Metric {
  std::string name;
  bool is_limit = false;    // the run is bad where its condition fails
  bool is_instant = false;  // in seconds, at which its condition held first
};

/// What is measured of each run: `conditions[i]` is that of `metrics[i]`.
struct Measures {
  std::vector<Metric> metrics;
  std::vector<expect::Condition> conditions;
};

struct Campaign {
  std::vector<Variation> vary;
  std::optional<std::int64_t> runs;  // none: as many as what is crossed has combinations
  Sampling sampling = Sampling::random;
  std::optional<Duration> length;  // of a run; none: to the end of its mission
  Measures measures;
};

inline constexpr std::int64_t max_runs = 1'000'000'000;

}  // namespace jarol::campaign
