// Numbers as people write them: durations with a unit, numbers with or without one, counts of bytes.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "graph/language/duration.h"

namespace jarol {

// Each returns an empty text and sets `to`, or says what is wrong: "is a bare number; write a unit, as in 10ms".

/// "10ms", "2.5us", "-1s": a whole number of nanoseconds with one of ns, us, ms, s, min, h.
std::string parse_duration(std::string_view text, Duration& to);

/// "1.5", "-2e-3", or with a unit: that of the description itself, or one that converts to it ("15deg" to rad).
std::string parse_number(std::string_view text, std::string_view unit, double& to);

/// "42", "-7": an integer from `min` to `max`.
std::string parse_integer(std::string_view text, std::int64_t min, std::int64_t max, std::int64_t& to);

/// "0x00D1", "209": the id of a system, in hex or decimal, up to `max`.
std::string parse_id(std::string_view text, std::int64_t max, std::int64_t& to);

/// "64KiB", "1MiB", "512B".
std::string parse_bytes(std::string_view text, std::int64_t& to);

/// The shortest decimal that reads back as the same number.
std::string number_text(double number);
std::string number_text(float number);

/// "1.5ms", "20us": in the largest unit that leaves a number of at least one.
std::string duration_text(Duration duration);

/// Seconds with all their nanoseconds and no trailing zeros: "0.05", "12", "0.000000001".
std::string seconds_text(Duration duration);

}  // namespace jarol
