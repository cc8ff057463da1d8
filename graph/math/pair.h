// Numbers as unevaluated sums hi + lo of two doubles, |lo| <= half an ulp of hi: some 104 bits by additions and
// multiplications alone. Dekker 1971 (products), Knuth 1969 (sums). Exact wherever nothing over- or underflows.
#pragma once

namespace jarol::math {

struct Pair {
  double hi, lo;
};

// four of them, for loops whose turns go side by side
struct Pairs {
  double hi[4], lo[4];
};

// a + b exactly, for |a| >= |b| or a = 0
constexpr Pair fast_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

// a + b exactly
constexpr Pair sum(double a, double b) {
  const double s = a + b;
  const double from_b = s - a;
  return {s, (a - (s - from_b)) + (b - from_b)};
}

// a = hi + lo in two halves of 26 bits
constexpr Pair halves(double a) {
  const double c = 134217729.0 * a;
  const double hi = c - (c - a);
  return {hi, a - hi};
}

// a b exactly, for |a|, |b| < 2^996 and no underflow
constexpr Pair product(double a, double b) {
  const double p = a * b;
  const Pair x = halves(a), y = halves(b);
  return {p, ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

constexpr Pair operator-(Pair a) { return {-a.hi, -a.lo}; }

constexpr Pair operator+(Pair a, Pair b) {
  Pair s = sum(a.hi, b.hi);
  const Pair t = sum(a.lo, b.lo);
  s = fast_sum(s.hi, s.lo + t.hi);
  return fast_sum(s.hi, s.lo + t.lo);
}

constexpr Pair operator+(Pair a, double b) {
  const Pair s = sum(a.hi, b);
  return fast_sum(s.hi, s.lo + a.lo);
}

constexpr Pair operator-(Pair a, Pair b) { return a + -b; }

constexpr Pair operator*(Pair a, Pair b) {
  const Pair p = product(a.hi, b.hi);
  return fast_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

constexpr Pair operator*(Pair a, double b) {
  const Pair p = product(a.hi, b);
  return fast_sum(p.hi, p.lo + a.lo * b);
}

constexpr Pair operator/(Pair a, Pair b) {
  const double q = a.hi / b.hi;
  const Pair rest = a - b * q;
  return fast_sum(q, rest.hi / b.hi);
}

inline Pair root(Pair a) {
  const double r = __builtin_sqrt(a.hi);
  const Pair square = product(r, r);
  return fast_sum(r, ((a.hi - square.hi) - square.lo + a.lo) / (2.0 * r));
}

constexpr Pair ln_2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
constexpr Pair ln_10{0x1.26bb1bbb55516p+1, -0x1.f48ad494ea3e9p-53};
constexpr Pair per_ln_2{0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};
constexpr Pair per_ln_10{0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};
constexpr Pair pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Pair half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

}  // namespace jarol::math
