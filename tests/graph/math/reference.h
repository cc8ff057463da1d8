// What MPFR says: each function's value to 160 bits, and how far a double is from it.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace reference {

struct Number {
  Number() { mpfr_init2(value, 160); }
  ~Number() { mpfr_clear(value); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
  mpfr_t value;
};

using Of1 = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using Of2 = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

// |result - exact| in units in the last place that a double next to `exact` has
inline double ulps(double result, const Number& exact) {
  const double near = mpfr_get_d(exact.value, MPFR_RNDN);
  if (std::isnan(near) || std::isinf(near) || std::isinf(result) || std::isnan(result))
    return near == result || (std::isnan(near) && std::isnan(result)) ? 0.0 : std::numeric_limits<double>::infinity();
  const int exponent = near == 0.0 ? -1074 : std::max(std::ilogb(near) - 52, -1074);
  Number error;
  mpfr_sub_d(error.value, exact.value, result, MPFR_RNDN);
  mpfr_mul_2si(error.value, error.value, -exponent, MPFR_RNDN);
  return std::fabs(mpfr_get_d(error.value, MPFR_RNDA));
}

}  // namespace reference
