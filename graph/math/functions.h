// The functions of C's <math.h> that are not exact, by fixed algorithms of additions, multiplications, divisions and
// roots alone: the same bits on every x86-64 processor and with every C library. They carry C's own names, so that
// whoever calls sin in a program that links them gets these, libraries loaded with it included. README.md has their
// errors.
#pragma once

extern "C" {
double sin(double) noexcept;
double cos(double) noexcept;
double tan(double) noexcept;
void sincos(double, double*, double*) noexcept;
double asin(double) noexcept;
double acos(double) noexcept;
double atan(double) noexcept;
double atan2(double y, double x) noexcept;
double sinh(double) noexcept;
double cosh(double) noexcept;
double tanh(double) noexcept;
double asinh(double) noexcept;
double acosh(double) noexcept;
double atanh(double) noexcept;
double exp(double) noexcept;
double exp2(double) noexcept;
double exp10(double) noexcept;
double expm1(double) noexcept;
double log(double) noexcept;
double log2(double) noexcept;
double log10(double) noexcept;
double log1p(double) noexcept;
double pow(double, double) noexcept;
double cbrt(double) noexcept;
double hypot(double, double) noexcept;

float sinf(float) noexcept;
float cosf(float) noexcept;
float tanf(float) noexcept;
void sincosf(float, float*, float*) noexcept;
float asinf(float) noexcept;
float acosf(float) noexcept;
float atanf(float) noexcept;
float atan2f(float y, float x) noexcept;
float sinhf(float) noexcept;
float coshf(float) noexcept;
float tanhf(float) noexcept;
float asinhf(float) noexcept;
float acoshf(float) noexcept;
float atanhf(float) noexcept;
float expf(float) noexcept;
float exp2f(float) noexcept;
float exp10f(float) noexcept;
float expm1f(float) noexcept;
float logf(float) noexcept;
float log2f(float) noexcept;
float log10f(float) noexcept;
float log1pf(float) noexcept;
float powf(float, float) noexcept;
float cbrtf(float) noexcept;
float hypotf(float, float) noexcept;

__extension__ double cabs(double _Complex) noexcept;
__extension__ double carg(double _Complex) noexcept;
__extension__ float cabsf(float _Complex) noexcept;
__extension__ float cargf(float _Complex) noexcept;
}
