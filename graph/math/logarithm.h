// log x = k ln 2 + log c + log(1 + r): x = 2^k m, 1/c in ten bits near 1/m, r = m/c - 1 exactly in two parts (Tang
// 1990).
#pragma once

#include "graph/math/bits.h"

namespace jarol::math {

// relative error below 2^-67 for finite x > 0
Pair log_pair(double x);
// of four normal x > 0, each to the same bits
void log_pairs(const double (&x)[4], Pairs& result);
// of x.hi + x.lo; absolute error besides x.lo / x.hi's own below 2^-100 near 1
Pair log_pair(Pair x);

}  // namespace jarol::math
