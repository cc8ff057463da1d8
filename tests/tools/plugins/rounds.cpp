// A plugin whose task rounds upward from its activation 1 on; ROUNDS says how.
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
#endif
  }
};
}  // namespace

JAROL_PLUGIN(Rounds)
