#include "graph/plugins/plugin.h"

namespace {
using jarol::describe, jarol::field, jarol::Tick;

struct LowPass {
  static constexpr std::string_view summary = "smooths its input";
  struct Param {
    double time = 0.1;
    static constexpr auto fields() { return describe(field<&Param::time>("s", "time constant")); }
  };
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct State {
    double out = 0;
    static constexpr auto fields() { return describe(field<&State::out>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>("", "the input, smoothed")); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
    const double period = std::chrono::duration<double>(tick.period).count();
    state.out += period / (p.time + period) * (in.in - state.out);
    out.out = state.out;
  }
};
}  // namespace

JAROL_PLUGIN(LowPass)
