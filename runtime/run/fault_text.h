// Why an activation was faulty, in words.
#pragma once

#include <optional>
#include <string>

#include "graph/language/quantities.h"
#include "graph/language/spec.h"
#include "graph/values/type.h"
#include "runtime/run/fault_summary.h"

namespace jarol {

/// One line, as it goes to people: "task 'a' activation 3 at 0.03 s: ...".
std::string to_text(const Fault& fault);

/// The first number of an output that is not finite: "output 'a.b' is nan".
std::string find_non_finite(const Type& type, const void* value);

/// The first number of an output that is not in the range of its field: "output 'a.b' is 0.7 rad, out of its range from
/// -0.6 to 0.6".
std::string find_out_of_range(const Type& type, const void* value);

/// How long after its release an activation ended; none: it had not when its outputs were due.
std::string late_text(std::optional<Duration> ended, Duration deadline);

inline constexpr const char* overrun_text = "left out: an activation before it still ran at its release";

/// What follows the cause of a fault that ends the run by the task's limit: "; the third ..."
std::string limit_text(const FaultLimit& limit);
bool is_by_limit(const Fault& fault);

}  // namespace jarol
