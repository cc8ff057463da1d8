// Whether many numbers are finite, at the price of reading them.
#pragma once

#include "runtime/machine/wide.h"

namespace jarol {

/// False if any is an infinity or a NaN, which no sum loses; or if the sum grows too great, which is rare and asks for
/// a closer look. `first` and `last` are at begins of cache lines.
bool are_surely_finite(const double* first, const double* last, bool wide = has_wide_vectors);

}  // namespace jarol
