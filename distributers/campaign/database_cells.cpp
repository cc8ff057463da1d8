#include "distributers/campaign/database_cells.h"

#include <sqlite3.h>

#include <charconv>
#include <cmath>

namespace jarol::campaign {

std::string text_of(sqlite3_stmt* row, int column) {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text == nullptr ? "" : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(row, column)));
}

void bind_text(sqlite3_stmt* to, int place, const std::string& text) {
  sqlite3_bind_text(to, place, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
}

void bind_number(sqlite3_stmt* to, int place, double number) {
  if (std::isfinite(number))
    sqlite3_bind_double(to, place, number);
  else
    bind_text(to, place, std::isnan(number) ? "nan" : number_text(number));  // of either sign
}

void bind_seed(sqlite3_stmt* to, int place, std::uint64_t seed) {
  const auto whole = static_cast<std::int64_t>(seed);
  if (whole >= 0)
    sqlite3_bind_int64(to, place, whole);
  else
    bind_text(to, place, std::to_string(seed));
}

void bind_value(sqlite3_stmt* to, int place, const std::string& value) {
  const char* const end = value.data() + value.size();
  std::int64_t whole = 0;
  if (const auto read = std::from_chars(value.data(), end, whole); read.ec == std::errc() && read.ptr == end) {
    sqlite3_bind_int64(to, place, whole);
    return;
  }
  double number = 0;
  const auto read = std::from_chars(value.data(), end, number);
  if (read.ec == std::errc() && read.ptr == end && std::isfinite(number))
    sqlite3_bind_double(to, place, number);
  else
    bind_text(to, place, value);
}

Reached reached_of(sqlite3_stmt* row, int column) {
  if (sqlite3_column_type(row, column) == SQLITE_FLOAT) return {sqlite3_column_double(row, column), ""};
  const std::string word = text_of(row, column);
  for (const double number : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    if (word == number_text(number)) return {number, ""};
  return {std::nullopt, word};
}

bool is_reached(sqlite3_stmt* row, int column) {
  const int type = sqlite3_column_type(row, column);
  if (type == SQLITE_FLOAT) return std::isfinite(sqlite3_column_double(row, column));
  return type == SQLITE_TEXT || type == SQLITE_NULL;
}

bool is_count(sqlite3_stmt* row, int column) {
  return sqlite3_column_type(row, column) == SQLITE_INTEGER && sqlite3_column_int64(row, column) >= 0;
}

}  // namespace jarol::campaign
