// The range that a field is declared with.
#pragma once

#include <limits>

namespace jarol {

/// Both ends belong to it; none is stated as long as they are infinite. Of a duration in nanoseconds.
struct FieldRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();

  constexpr bool is_stated() const { return min > -std::numeric_limits<double>::infinity(); }
  constexpr bool has(double number) const { return number >= min && number <= max; }
};

}  // namespace jarol
