// The floating-point environment that all tasks compute in: rounding to nearest, subnormal numbers kept, no exception
// raises a signal. Determinism rests on it (IEEE 754-2019, 4.3; C11, F.7 and F.8).
#pragma once

#include <string>

namespace jarol {

/// Bits that decide what arithmetic yields; flags that an operation leaves behind are not among them.
struct FloatingPointControl {
  unsigned vector = 0;  // MXCSR without its flags
  unsigned x87 = 0;     // control word

  friend bool operator==(const FloatingPointControl&, const FloatingPointControl&) = default;
};

/// Of the calling thread.
FloatingPointControl floating_point_control();
void set_floating_point_control(const FloatingPointControl& control);

/// What each thread that runs tasks has.
FloatingPointControl default_floating_point_control();

/// How a control differs from the default: "flush-to-zero, rounding upward"; empty: it doesn't.
std::string describe_difference(const FloatingPointControl& control);

/// The default within a scope; afterwards what was before.
class DefaultFloatingPoint {
 public:
  DefaultFloatingPoint() : before_(floating_point_control()) {
    set_floating_point_control(default_floating_point_control());
  }
  ~DefaultFloatingPoint() { set_floating_point_control(before_); }
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

 private:
  FloatingPointControl before_;
};

/// Restores the default and throws std::runtime_error that says how the environment differed.
[[noreturn, gnu::cold]] void reject_floating_point();

namespace detail {

// Sums whose results depend on rounding mode, flush-to-zero and denormals-are-zero. Reading MXCSR takes as long as a
// whole activation; two additions take next to nothing, for nothing waits for them.
struct alignas(16) Pair {
  double low, high;
};
inline constexpr Pair one{1.0, 1.0};
inline constexpr Pair little{0x1p-60, -0x1p-60};           // too little to change 1 where one rounds to nearest
inline constexpr Pair small{0x1.8p-1022, 0x1p-1023};       // normal, subnormal
inline constexpr Pair other{-0x1p-1022, 0x1p-1023};        // normal, subnormal
inline constexpr Pair sum_of_small{0x1p-1023, 0x1p-1022};  // subnormal, normal

}  // namespace detail

/// False if the calling thread's arithmetic on doubles isn't that of the default environment.
inline bool computes_by_default() {
#if defined(__x86_64__)
  using Bits [[gnu::vector_size(16)]] = unsigned;
  Bits rounded, small;
  // in assembly, so that no optimisation of the including file computes it in advance
  asm volatile(
      "movapd %[one], %[rounded]\n\t"
      "addpd %[little], %[rounded]\n\t"
      "pcmpeqd %[one], %[rounded]\n\t"
      "movapd %[a], %[small]\n\t"
      "addpd %[b], %[small]\n\t"
      "pcmpeqd %[sum], %[small]\n\t"
      "pand %[small], %[rounded]"
      : [rounded] "=&x"(rounded), [small] "=&x"(small)
      : [one] "m"(detail::one), [little] "m"(detail::little), [a] "m"(detail::small), [b] "m"(detail::other),
        [sum] "m"(detail::sum_of_small));
  unsigned mask;
  asm("pmovmskb %1, %0" : "=r"(mask) : "x"(rounded));
  return mask == 0xffff;
#else
  return floating_point_control() == default_floating_point_control();
#endif
}

}  // namespace jarol
