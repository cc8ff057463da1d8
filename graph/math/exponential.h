// e^x = 2^k m with m in [0.99, 2.01]: x = (128 k + i) ln 2 / 128 + r, and e^r by its series (Tang 1989).
#pragma once

#include "graph/math/bits.h"

namespace jarol::math {

struct Scaled {
  Pair m;
  int k;
  double rounded() const { return scaled(m, k); }
};

// relative error below 2^-66, for |x| < 1200
Scaled exp_pair(Pair x);
// e^x rounded, error below 0.51 ulp, for |x| < 1200
double exp_rounded(Pair x);
// of four |x| < 700, each to the same bits
void exp_rounded(const Pairs& x, double (&result)[4]);

}  // namespace jarol::math
