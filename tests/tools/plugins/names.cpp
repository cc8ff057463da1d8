// Tasks with names that Jarol's own headers use, too, written as README shows it.
#include "graph/plugins/plugin.h"

namespace {
using jarol::describe, jarol::field, jarol::Tick;

struct Source {
  static constexpr std::string_view summary = "counts";
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick& tick, Out& out) { out.out = static_cast<double>(tick.activation); }
};

struct Problem {
  static constexpr std::string_view summary = "does nothing";
  static void run(const Tick&) {}
};

struct Sequence {
  static constexpr std::string_view summary = "hands on";
  struct In {
    jarol::Sequence<double> in{};
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  static void run(const Tick&, const In&) {}
};

struct Talks {
  static constexpr std::string_view summary = "says something now and then";
  struct Out {
    jarol::String log{};
    double other = 0;
    static constexpr auto fields() {
      return describe(field<&Out::log>("", "what is worth knowing"), field<&Out::other>());
    }
  };
  static void run(const Tick& tick, Out& out) {
    if (tick.activation == 2) out.log = "two\x1b[31m";
    if (tick.activation == 5) out.log = "";
    if (tick.activation == 6) out.log = "two\x1b[31m";
    if (tick.activation > 7) out.log = jarol::String(tick.activation % 2 == 0 ? "even" : "odd");
  }
};
}  // namespace

JAROL_PLUGIN(Source, Problem, Sequence, Talks)
