// Powers of several numbers at once, each to the bits that `pow` gives.
#pragma once

#include <array>

namespace jarol::math {

/// Takes half as long as four calls.
std::array<double, 4> pow_each(const std::array<double, 4>& x, double y);

}  // namespace jarol::math
