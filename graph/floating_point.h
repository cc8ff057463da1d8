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

/// The default again, after a task that did not end by itself.
void restore_floating_point();

/// Restores the default and throws std::runtime_error that says how the environment differed.
[[noreturn, gnu::cold]] void reject_floating_point();

namespace detail {

// Four sums at once whose results depend on rounding mode, flush-to-zero and denormals-are-zero, which are the same for
// every width. Reading MXCSR takes as long as a whole activation; one addition takes next to nothing, for nothing waits
// for it.
struct alignas(16) Four {
  float lanes[4];
};
// too little to change 1 upwards or downwards where one rounds to nearest; a subnormal sum; subnormal summands
inline constexpr Four summands{{1.0F, 1.0F, 0x1.8p-126F, 0x1p-127F}};
inline constexpr Four others{{0x1p-30F, -0x1p-30F, -0x1p-126F, 0x1p-127F}};
inline constexpr Four sums{{1.0F, 1.0F, 0x1p-127F, 0x1p-126F}};

}  // namespace detail

/// False if the calling thread's arithmetic on doubles isn't that of the default environment.
inline bool computes_by_default() {
#if defined(__x86_64__)
  using Bits [[gnu::vector_size(16)]] = unsigned;
  Bits sum;
  unsigned equal;
  // in assembly, so that no optimisation of the including file computes it in advance
  asm volatile(
      "movaps %[summands], %[sum]\n\t"
      "addps %[others], %[sum]\n\t"
      "pcmpeqd %[sums], %[sum]\n\t"
      "movmskps %[sum], %[equal]"
      : [sum] "=&x"(sum), [equal] "=r"(equal)
      : [summands] "m"(detail::summands), [others] "m"(detail::others), [sums] "m"(detail::sums));
  return equal == 0xf;
#else
  return floating_point_control() == default_floating_point_control();
#endif
}

}  // namespace jarol
