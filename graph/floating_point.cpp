#include "graph/floating_point.h"

#include <cfenv>
#include <cstdint>
#include <stdexcept>

namespace jarol {
namespace {

#if defined(__x86_64__)
// Intel SDM volume 1, 8.1.5 and 10.2.3
constexpr unsigned vector_flags = 0x3f;
constexpr FloatingPointControl by_default{0x1f80, 0x37f, 0};
constexpr unsigned masks = 0x3f, vector_masks = masks << 7;
constexpr unsigned flush_to_zero = 1U << 15, denormals_are_zero = 1U << 6;
constexpr unsigned vector_rounding = 3U << 13, x87_rounding = 3U << 10, x87_precision = 3U << 8;

const char* rounding_name(unsigned bits) {
  constexpr const char* names[] = {"to nearest", "downward", "upward", "toward zero"};
  return names[bits & 3U];
}
#endif

}  // namespace

#if defined(__x86_64__)

FloatingPointControl floating_point_control() {
  // the one instruction that shows all three; Intel SDM volume 1, 10.5.1
  struct alignas(16) {
    std::uint16_t x87, status;
    std::uint8_t used, reserved[19];
    std::uint32_t vector;
    std::uint8_t rest[484];
  } saved;  // written whole, so that nothing is to be laid there before
  static_assert(sizeof saved == 512);
  asm volatile("fxsave %0" : "=m"(saved));
  // bit 6 of the x87 control word is reserved and reads as either
  return {saved.vector & ~vector_flags, saved.x87 & ~0xe0c0U, saved.used};
}

void set_floating_point_control(const FloatingPointControl& control) {
  const unsigned vector = control.vector;
  const auto x87 = static_cast<unsigned short>(control.x87 | 0x40U);
  asm volatile("ldmxcsr %0" : : "m"(vector));
  // flags that are set would raise what the new word no longer masks; registers are empty then
  asm volatile("fninit\n\tfldcw %0" : : "m"(x87));
}

FloatingPointControl default_floating_point_control() { return {by_default.vector, by_default.x87 & ~0x40U, 0}; }

void restore_floating_point() {
  std::uint16_t x87 = 0, status = 0;
  asm volatile("fnstcw %0\n\tfnstsw %1" : "=m"(x87), "=m"(status));
  const bool is_default = (x87 | 0x40U) == by_default.x87 && (status & masks) == 0;
  if (!is_default) return set_floating_point_control(default_floating_point_control());
  // of the x87 unit only registers may be in use, and these are emptied in a fraction of the 20 ns of fninit
  asm volatile("ldmxcsr %0\n\temms" : : "m"(by_default.vector));
}

std::string describe_difference(const FloatingPointControl& control) {
  const FloatingPointControl expected = default_floating_point_control();
  const unsigned vector = control.vector ^ expected.vector, x87 = control.x87 ^ expected.x87;
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if ((vector & flush_to_zero) != 0) add("flush-to-zero");
  if ((vector & denormals_are_zero) != 0) add("denormals-are-zero");
  if ((vector & vector_rounding) != 0) add(std::string("rounding ") + rounding_name(control.vector >> 13));
  if ((vector & vector_rounding) == 0 && (x87 & x87_rounding) != 0)
    add(std::string("rounding of long double ") + rounding_name(control.x87 >> 10));
  if ((x87 & x87_precision) != 0) add("less precision of long double");
  if ((vector & vector_masks) != 0 || (x87 & masks) != 0) add("exceptions that raise a signal");
  if (control.used != 0) add("registers of long double in use");
  return text;
}

#else

FloatingPointControl floating_point_control() { return {static_cast<unsigned>(std::fegetround()), 0, 0}; }

void set_floating_point_control(const FloatingPointControl& control) {
  std::fesetround(static_cast<int>(control.vector));
}

FloatingPointControl default_floating_point_control() { return {FE_TONEAREST, 0, 0}; }

void restore_floating_point() { set_floating_point_control(default_floating_point_control()); }

std::string describe_difference(const FloatingPointControl& control) {
  return control == default_floating_point_control() ? "" : "another rounding mode";
}

#endif

void require_default_floating_point() {
  const FloatingPointControl control = floating_point_control();
  if (control == default_floating_point_control()) [[likely]]
    return;
  restore_floating_point();
  throw std::runtime_error("left another floating-point environment behind: " + describe_difference(control));
}

}  // namespace jarol
