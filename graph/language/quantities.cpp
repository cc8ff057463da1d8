#include "graph/language/quantities.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "graph/language/units.h"

namespace jarol {
namespace {

struct Scale {
  std::string_view name;
  std::int64_t factor;
};

constexpr std::array<Scale, 6> durations{{{"h", 3'600'000'000'000},
                                          {"min", 60'000'000'000},
                                          {"s", 1'000'000'000},
                                          {"ms", 1'000'000},
                                          {"us", 1'000},
                                          {"ns", 1}}};

constexpr std::array<Scale, 4> byte_units{{{"B", 1}, {"KiB", 1 << 10}, {"MiB", 1 << 20}, {"GiB", 1 << 30}}};

struct Conversion {
  std::string_view from;
  std::string_view to;
  double factor;
};

constexpr double degree = std::numbers::pi / 180.0;
constexpr std::array<Conversion, 15> conversions{{{"deg", "rad", degree},
                                                  {"Hz", "rad/s", 2 * std::numbers::pi},
                                                  {"mrad", "rad", 1e-3},
                                                  {"deg/s", "rad/s", degree},
                                                  {"mrad/s", "rad/s", 1e-3},
                                                  {"km", "m", 1e3},
                                                  {"cm", "m", 1e-2},
                                                  {"mm", "m", 1e-3},
                                                  {"cm/s", "m/s", 1e-2},
                                                  {"mm/s", "m/s", 1e-3},
                                                  {"min", "s", 60.0},
                                                  {"ms", "s", 1e-3},
                                                  {"us", "s", 1e-6},
                                                  {"g", "kg", 1e-3},
                                                  {"kN", "N", 1e3}}};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Splits "2.5ms" into the number and the unit; blanks may stand between.
struct Split {
  std::string_view number;
  std::string_view unit;
};

Split split_unit(std::string_view text) {
  std::size_t end = 0;
  if (end < text.size() && text[end] == '-') ++end;
  while (end < text.size() && (is_digit(text[end]) || text[end] == '.')) ++end;
  // an exponent belongs to the number only if digits follow
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t digits = end + 1;
    if (digits < text.size() && (text[digits] == '-' || text[digits] == '+')) ++digits;
    if (digits < text.size() && is_digit(text[digits])) {
      end = digits;
      while (end < text.size() && is_digit(text[end])) ++end;
    }
  }
  std::size_t unit = end;
  while (unit < text.size() && text[unit] == ' ') ++unit;
  return {text.substr(0, end), text.substr(unit)};
}

bool has_leading_zero(std::string_view number) {
  if (!number.empty() && number[0] == '-') number.remove_prefix(1);
  return number.size() > 1 && number[0] == '0' && is_digit(number[1]);
}

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

template <std::size_t N>
std::string names(const std::array<Scale, N>& scales) {
  std::string text;
  for (std::size_t i = 0; i < N; ++i) text += (i == 0 ? "" : i + 1 == N ? " or " : ", ") + std::string(scales[i].name);
  return text;
}

// number * factor as a whole number of the smallest unit; decimal, so that 0.1ms is exactly 100000ns
std::string scale_exactly(std::string_view number, std::int64_t factor, std::string_view whole, std::int64_t& to) {
  const bool negative = !number.empty() && number[0] == '-';
  if (negative) number.remove_prefix(1);
  const std::size_t point = number.find('.');
  const std::string_view integer = number.substr(0, point);
  std::string_view fraction = point == std::string_view::npos ? "" : number.substr(point + 1);
  while (!fraction.empty() && fraction.back() == '0') fraction.remove_suffix(1);
  if (integer.empty() || fraction.find('.') != std::string_view::npos) return "is not a number";
  constexpr const char* too_large = "is too large";
  std::int64_t sum = 0;
  for (const char c : integer)
    if (__builtin_mul_overflow(sum, 10, &sum) || __builtin_add_overflow(sum, c - '0', &sum)) return too_large;
  if (__builtin_mul_overflow(sum, factor, &sum)) return too_large;
  for (const char c : fraction) {
    if (factor % 10 != 0) return "is not a whole number of " + std::string(whole);
    factor /= 10;
    if (__builtin_add_overflow(sum, factor * (c - '0'), &sum)) return too_large;
  }
  to = negative ? -sum : sum;
  return "";
}

template <class Number>
std::string shortest(Number number) {
  std::array<char, 40> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), number);
  return {text.data(), result.ptr};
}

// The decimal digits of value / 10^places without trailing zeros.
std::string decimal(std::int64_t value, int places) {
  const bool negative = value < 0;
  std::string digits =
      std::to_string(negative ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value));
  const auto width = static_cast<std::size_t>(places) + 1;
  if (digits.size() < width) digits.insert(0, width - digits.size(), '0');
  if (places > 0) {
    digits.insert(digits.size() - static_cast<std::size_t>(places), ".");
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
  }
  return negative ? "-" + digits : digits;
}

}  // namespace

std::string parse_duration(std::string_view text, Duration& to) {
  const auto [number, unit] = split_unit(text);
  if (number.empty() || number.find_first_of("eE") != std::string_view::npos)
    return "is not a duration; write a number and a unit, as in 10ms";
  if (has_leading_zero(number)) return "begins with a zero; write it without";
  if (unit.empty()) return "has no unit; write one of " + names(durations) + ", as in 10ms";
  for (const Scale& scale : durations) {
    if (scale.name != unit) continue;
    std::int64_t nanoseconds = 0;
    const std::string wrong = scale_exactly(number, scale.factor, "nanoseconds", nanoseconds);
    if (wrong.empty()) to = Duration(nanoseconds);
    return wrong;
  }
  return "has the unit " + quoted(unit) + "; write one of " + names(durations);
}

std::string parse_number(std::string_view text, std::string_view unit, double& to) {
  const auto [number, suffix] = split_unit(text);
  if (number.find_first_of("0123456789") == std::string_view::npos) return "is not a number";
  if (has_leading_zero(number)) return "begins with a zero; write it without";
  double factor = 1.0;
  if (!suffix.empty() && suffix != unit) {
    const Conversion* found = nullptr;
    for (const Conversion& c : conversions)
      if (c.from == suffix && c.to == unit) found = &c;
    if (found == nullptr)
      return "has the unit " + quoted(suffix) + (unit.empty() ? "; it has none" : "; it is in " + std::string(unit));
    factor = found->factor;
  }
  double value = 0;
  const auto result = std::from_chars(number.data(), number.data() + number.size(), value);
  if (result.ec == std::errc::result_out_of_range) return "is beyond what a double holds";
  if (number.empty() || result.ec != std::errc() || result.ptr != number.data() + number.size())
    return "is not a number";
  value *= factor;
  if (!std::isfinite(value)) return "is not finite";
  to = value;
  return "";
}

std::string parse_integer(std::string_view text, std::int64_t min, std::int64_t max, std::int64_t& to) {
  if (has_leading_zero(text)) return "begins with a zero; write it without";
  std::int64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = result.ec != std::errc::invalid_argument && result.ptr == text.data() + text.size();
  if (!whole || text.empty()) return "is not an integer";
  if (result.ec == std::errc::result_out_of_range || value < min || value > max)
    return "is not from " + std::to_string(min) + " to " + std::to_string(max);
  to = value;
  return "";
}

std::string parse_id(std::string_view text, std::int64_t max, std::int64_t& to) {
  const bool hex = text.starts_with("0x") || text.starts_with("0X");
  if (!hex && has_leading_zero(text)) return "begins with a zero; write it without, or in hex, as in 0x00D1";
  const std::string_view digits = hex ? text.substr(2) : text;
  std::uint64_t value = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value, hex ? 16 : 10);
  if (result.ec == std::errc::invalid_argument || result.ptr != digits.data() + digits.size())
    return "is not an id; write it in hex or decimal, as in 0x00D1 or 209";
  if (result.ec == std::errc::result_out_of_range || value > static_cast<std::uint64_t>(max))
    return "is not from 0 to " + std::to_string(max);
  to = static_cast<std::int64_t>(value);
  return "";
}

std::string parse_bytes(std::string_view text, std::int64_t& to) {
  const auto [number, unit] = split_unit(text);
  if (number.empty() || number[0] == '-' || number.find_first_of("eE") != std::string_view::npos)
    return "is not a size; write a number and a unit, as in 64KiB";
  if (has_leading_zero(number)) return "begins with a zero; write it without";
  if (unit.empty()) return "has no unit; write one of " + names(byte_units) + ", as in 64KiB";
  for (const Scale& scale : byte_units)
    if (scale.name == unit) return scale_exactly(number, scale.factor, "bytes", to);
  return "has the unit " + quoted(unit) + "; write one of " + names(byte_units);
}

std::string number_text(double number) { return shortest(number); }
std::string number_text(float number) { return shortest(number); }

std::string duration_text(Duration duration) {
  const std::int64_t value = duration.count();
  if (value == 0) return "0ns";
  const std::uint64_t size = value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
  if (size < 1'000) return decimal(value, 0) + "ns";
  if (size < 1'000'000) return decimal(value, 3) + "us";
  if (size < 1'000'000'000) return decimal(value, 6) + "ms";
  return decimal(value, 9) + "s";
}

std::string seconds_text(Duration duration) { return decimal(duration.count(), 9); }

std::vector<std::string> units_for(const std::string& unit) {
  std::vector<std::string> units{unit};
  for (const Conversion& conversion : conversions)
    if (conversion.to == unit) units.emplace_back(conversion.from);
  return units;
}

}  // namespace jarol
