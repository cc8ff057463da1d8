// A task in a plugin, which finds what it uses in the program that loads it.
#include <jarol/plugin.h>

namespace {
using jarol::describe, jarol::field, jarol::Tick;

struct Doubling {
  static constexpr std::string_view summary = "twice its input";
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick&, const In& in, Out& out) { out.out = 2 * in.in; }
};
}  // namespace

JAROL_PLUGIN(Doubling)
