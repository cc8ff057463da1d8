// In single precision, and absolute value and argument of complex numbers: by the functions of doubles, rounded once
// more.
#include "graph/math/functions.h"

namespace {

inline float narrow(double x) { return static_cast<float>(x); }

}  // namespace

float sinf(float x) noexcept { return narrow(sin(x)); }
float cosf(float x) noexcept { return narrow(cos(x)); }
float tanf(float x) noexcept { return narrow(tan(x)); }
void sincosf(float x, float* s, float* c) noexcept {
  double sine, cosine;
  sincos(x, &sine, &cosine);
  *s = narrow(sine);
  *c = narrow(cosine);
}
float asinf(float x) noexcept { return narrow(asin(x)); }
float acosf(float x) noexcept { return narrow(acos(x)); }
float atanf(float x) noexcept { return narrow(atan(x)); }
float atan2f(float y, float x) noexcept { return narrow(atan2(y, x)); }
float sinhf(float x) noexcept { return narrow(sinh(x)); }
float coshf(float x) noexcept { return narrow(cosh(x)); }
float tanhf(float x) noexcept { return narrow(tanh(x)); }
float asinhf(float x) noexcept { return narrow(asinh(x)); }
float acoshf(float x) noexcept { return narrow(acosh(x)); }
float atanhf(float x) noexcept { return narrow(atanh(x)); }
float expf(float x) noexcept { return narrow(exp(x)); }
float exp2f(float x) noexcept { return narrow(exp2(x)); }
float exp10f(float x) noexcept { return narrow(exp10(x)); }
float expm1f(float x) noexcept { return narrow(expm1(x)); }
float logf(float x) noexcept { return narrow(log(x)); }
float log2f(float x) noexcept { return narrow(log2(x)); }
float log10f(float x) noexcept { return narrow(log10(x)); }
float log1pf(float x) noexcept { return narrow(log1p(x)); }
float powf(float x, float y) noexcept { return narrow(pow(x, y)); }
float cbrtf(float x) noexcept { return narrow(cbrt(x)); }
float hypotf(float x, float y) noexcept { return narrow(hypot(x, y)); }

__extension__ double cabs(double _Complex z) noexcept { return hypot(__real__ z, __imag__ z); }
__extension__ double carg(double _Complex z) noexcept { return atan2(__imag__ z, __real__ z); }
__extension__ float cabsf(float _Complex z) noexcept { return hypotf(__real__ z, __imag__ z); }
__extension__ float cargf(float _Complex z) noexcept { return atan2f(__imag__ z, __real__ z); }
