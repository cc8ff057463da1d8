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
}  // namespace

JAROL_PLUGIN(Source, Problem, Sequence)
