// Powers of several numbers at once, each to the bits that `pow` gives.
#pragma once

#include <array>

namespace jarol::math {

/// Side by side, where all are normal numbers above zero and no power is near the limits; else by four calls.
std::array<double, 4> pow_each(const std::array<double, 4>& x, double y);

}  // namespace jarol::math
