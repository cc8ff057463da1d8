// The floating-point environment that all tasks compute in: rounding to nearest, subnormal numbers kept, no exception
// raises a signal. Determinism rests on it (IEEE 754-2019, 4.3; C11, F.7 and F.8).
#pragma once

#include <string>

namespace jarol {

/// Bits that decide what arithmetic yields; flags that an operation leaves behind are not among them.
struct FloatingPointControl {
  unsigned vector = 0;  // MXCSR without its flags
  unsigned x87 = 0;     // control word
  unsigned used = 0;    // registers of long double that hold something, a bit each: none, between tasks

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

/// After a task: where the calling thread's environment isn't the default, restores that and throws std::runtime_error
/// that says how it differed. Takes some 25 ns, for the registers in use are slow to read; tasks whose machine code
/// can't change the environment go without (graph/plugins/machine_code.h).
void require_default_floating_point();

}  // namespace jarol
