// Where two runs of the same outputs part: the first difference, and of each signal from when on and by how much.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/record/message_layout.h"

namespace jarol {

struct FirstDifference {
  Duration instant{};
  std::string output, field;          // field: "" where it is the whole value
  std::string was, is;                // as text; "nothing": it was not published then
  std::string was_bits{}, is_bits{};  // of numbers
};

/// Of one field, or of an output that only one of them has published.
struct SignalDifference {
  std::string name, unit;
  std::uint64_t values = 0;  // that differ
  Duration first{};
  std::optional<double> largest{};  // none: they are no numbers
  Duration largest_at{};
};

class Differences {
 public:
  /// Of the output of that name with messages of that layout, both from the root of a run: what it was and what it is
  /// at that instant, null where it was not published. In order of instants, and within one of names.
  void compare(Duration instant, const std::string& output, const MessageLayout& layout, const std::string_view* was,
               const std::string_view* is);

  /// Values that both have.
  std::uint64_t compared() const { return compared_; }
  const std::optional<FirstDifference>& first() const { return first_; }
  /// In order of the first instants, then of names.
  std::vector<SignalDifference> signals() const;

 private:
  void count(const std::string& name, const std::string& unit, Duration instant, std::optional<double> distance);

  std::uint64_t compared_ = 0;
  std::optional<FirstDifference> first_;
  std::map<std::string, SignalDifference> signals_;
};

/// "depth.moment.z at 1.25 s: was 0.5 (0x3fe0000000000000), is 0.25 (0x3fd0000000000000)".
std::string text_of(const FirstDifference& first);
/// "from 1.25 s on, by at most 0.25 N m at 3 s".
std::string text_of(const SignalDifference& signal);

}  // namespace jarol
