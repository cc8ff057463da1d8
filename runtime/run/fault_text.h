// Why an activation was faulty, in words.
#pragma once

#include <optional>
#include <string>

#include "graph/language/quantities.h"
#include "graph/values/type.h"
#include "runtime/run/fault_summary.h"

namespace jarol {

/// One line, as it goes to people: "task 'a' activation 3 at 0.03 s: ...".
std::string to_text(const Fault& fault);

/// The first number of an output that is not finite: "output 'a.b' is nan".
std::string find_non_finite(const Type& type, const void* value);

/// How long after its release an activation ended; none: it had not when its outputs were due.
std::string late_text(std::optional<Duration> ended, Duration deadline);

inline constexpr const char* overrun_text = "left out: an activation before it still ran at its release";

}  // namespace jarol
