// A plugin as a user would write it: two tasks, one of them on values of changing size.
#include "graph/plugins/plugin.h"

namespace {
using namespace jarol;

struct Twice {
  static constexpr std::string_view summary = "doubles its input";
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>("", "twice the input")); }
  };
  static void run(const Tick&, const In& in, Out& out) { out.out = 2 * in.in; }
};

struct Reverse {
  static constexpr std::string_view summary = "turns a sequence round";
  struct In {
    Sequence<double> in{};
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    Sequence<double> out{};
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick&, const In& in, Out& out) {
    Sequence<double> turned;  // scratch
    for (std::size_t i = in.in.size(); i > 0; --i) turned.push_back(in.in[i - 1]);
    out.out = turned;
    if (turned.size() > 3) throw std::out_of_range("more than three");
  }
};
}  // namespace

JAROL_PLUGIN(Twice, Reverse)
