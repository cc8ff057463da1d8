// A task that calls mathematics of the C library, some of it not defined to the bit.
#include <cmath>

#include "graph/plugins/plugin.h"

namespace {
using namespace jarol;

struct CLibrary {
  static constexpr std::string_view summary = "sums up functions of its time";
  struct Out {
    double out = 0.0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick& tick, Out& out) {
    const double t = std::chrono::duration<double>(tick.now).count() + 1.1;
    out.out = std::tgamma(t) + static_cast<double>(std::sin(static_cast<long double>(t))) + std::fmod(3, t) +
              std::sin(t) + std::cos(static_cast<float>(t));
  }
};
}  // namespace

JAROL_PLUGIN(CLibrary)
