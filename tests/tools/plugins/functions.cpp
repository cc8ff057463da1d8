// A task that calls the functions of <cmath>, as a user's does.
#include <cmath>

#include "graph/plugins/plugin.h"

namespace {
using namespace jarol;

struct Functions {
  static constexpr std::string_view summary = "sums up functions of its time";
  struct Out {
    double out = 0.0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick& tick, Out& out) {
    const double t = std::chrono::duration<double>(tick.now).count() + 0.1;
    out.out = std::sin(t) + std::exp(std::cos(3 * t)) + std::pow(t, 0.3) + std::atan2(t, 0.7) + std::log(t) +
              std::tan(t) + std::asin(std::tanh(t)) + std::expm1(0.1 * t) + std::sin(static_cast<float>(t)) +
              std::hypot(t, 1.1);
  }
};
}  // namespace

JAROL_PLUGIN(Functions)
