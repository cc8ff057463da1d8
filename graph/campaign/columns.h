// The columns that the results of every campaign have, beside those of what varies and of the metrics.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace jarol::campaign {

/// Of the database, before the others.
inline constexpr std::array<std::string_view, 8> database_columns{"run",          "seed",   "outcome", "why",
                                                                  "simulated_ns", "faults", "digest",  "not_judged"};
/// Of the table, before the others and after them.
inline constexpr std::array<std::string_view, 2> first_table_columns{"run", "seed"};
inline constexpr std::array<std::string_view, 6> last_table_columns{"outcome", "faults", "simulated_s",
                                                                    "digest",  "why",    "not_judged"};

/// SQL takes names that differ in case alone for one.
inline bool is_same_column(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char left, unsigned char right) { return std::tolower(left) == std::tolower(right); });
}

/// Does every campaign have a column of that name?
inline bool is_common_column(std::string_view name) {
  const auto is_in = [&](const auto& columns) {
    return std::any_of(columns.begin(), columns.end(), [&](auto column) { return is_same_column(column, name); });
  };
  return is_in(database_columns) || is_in(first_table_columns) || is_in(last_table_columns);
}

}  // namespace jarol::campaign
