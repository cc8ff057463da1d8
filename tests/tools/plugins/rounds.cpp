// A plugin whose task changes the floating-point environment in its activation 1; ROUNDS says how.
#include <dlfcn.h>

#include <cfenv>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "graph/plugins/plugin.h"

namespace {
struct Rounds {
  static constexpr std::string_view summary = "for tests";
  struct Out {
    double third = 0;
    static constexpr auto fields() { return jarol::describe(jarol::field<&Out::third>()); }
  };
  static void run(const jarol::Tick& tick, Out& out) {
    std::vector<double> thirds{static_cast<double>(tick.activation) / 3};
    if (thirds.size() > 1) throw std::runtime_error("never");
    out.third = std::sqrt(std::sin(thirds[0])) + std::floor(std::fmod(thirds[0], 2.0));
    if (tick.activation != 1) return;
    [[maybe_unused]] const unsigned upward = 0x5f80;
#if ROUNDS == 1
    std::fesetround(FE_UPWARD);
#elif ROUNDS == 2
    asm volatile("ldmxcsr %0" : : "m"(upward));
#elif ROUNDS == 3
    asm volatile("vldmxcsr %0" : : "m"(upward));
#elif ROUNDS == 4
    alignas(16) unsigned char all[512];
    asm volatile("fxsave %0" : "=m"(all));
    std::memcpy(all + 24, &upward, sizeof upward);
    asm volatile("fxrstor %0" : : "m"(all));
#elif ROUNDS == 5
    reinterpret_cast<int (*)(int)>(dlsym(RTLD_DEFAULT, "fesetround"))(FE_UPWARD);
#elif ROUNDS == 6
    jarol::set_floating_point_control({upward, 0x33f});
#elif ROUNDS == 7
    const unsigned short old_upward = 0xb7f;
    asm volatile("fldcw %0" : : "m"(old_upward));
#elif ROUNDS == 8
    const unsigned short half_as_precise = 0x27f;
    asm volatile("fldcw %0" : : "m"(half_as_precise));
#elif ROUNDS == 9
    // of its arithmetic nothing but a division by zero raises a signal
    const unsigned unmasked = 0x1d80;
    asm volatile("ldmxcsr %0" : : "m"(unmasked));
#elif ROUNDS == 10
    feenableexcept(FE_DIVBYZERO);
#elif ROUNDS == 11
    const unsigned precise = 0x0f80;  // every rounded result raises one
    asm volatile("ldmxcsr %0" : : "m"(precise));
#elif ROUNDS == 12
    asm volatile("pxor %%mm0, %%mm0" ::: "mm0");
#elif ROUNDS == 13
    asm volatile("fld1\n fld1\n fld1\n fld1\n fld1\n fld1\n fld1\n fld1");  // the top is where it was
#endif
  }
};
}  // namespace

JAROL_PLUGIN(Rounds)
