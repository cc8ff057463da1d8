// The faults of a run, summed up by task and cause.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "graph/language/quantities.h"
#include "graph/values/archive.h"

namespace jarol {

/// A fault as the report has it.
struct Fault {
  std::string task;
  std::int64_t activation = 0;
  Duration instant{};  // at which it would have published
  std::string cause;

  void serialize(Archive& archive) { archive(task, activation, instant, cause); }
};

/// The same in words that belong to somebody else: most faults repeat an earlier one, and need no memory.
struct FaultWords {
  std::string_view task;
  std::int64_t activation = 0;
  Duration instant{};
  std::string_view cause;

  Fault kept() const { return {std::string(task), activation, instant, std::string(cause)}; }
};

/// Faults of one task whose causes differ in their numbers alone.
struct FaultGroup {
  Fault first;
  std::int64_t last_activation = 0;
  Duration last_instant{};
  std::uint64_t count = 0;

  void serialize(Archive& archive) { archive(first, last_activation, last_instant, count); }
};

class FaultSummary {
 public:
  static constexpr std::size_t max_groups = 100;

  void add(const FaultWords& fault);

  /// In the order of their first faults.
  const std::vector<FaultGroup>& groups() const { return groups_; }
  /// Faults of causes that came when there were as many groups as are kept.
  std::uint64_t others() const { return others_; }

  void serialize(Archive& archive) { archive(groups_, others_); }

 private:
  std::vector<FaultGroup> groups_;
  std::uint64_t others_ = 0;
};

/// True of texts that are the same but for the digits in them, and for the units that follow digits.
bool same_but_for_numbers(std::string_view a, std::string_view b);

}  // namespace jarol
