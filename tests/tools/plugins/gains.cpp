// Two versions of a law, with constants of other values and a struct of another layout by the same names.
#include "graph/plugins/plugin.h"

using jarol::describe, jarol::field, jarol::Tick;

struct Gains {
#ifdef NEWER
  static constexpr std::array<double, 4> table{10, 20, 30, 40};
#else
  static constexpr std::array<double, 4> table{1, 2, 3, 4};
#endif
};

struct Pose {
#ifdef NEWER
  float quality = 0.5;
  double x = 0;
  static constexpr auto fields() { return describe(field<&Pose::quality>(), field<&Pose::x>()); }
#else
  double x = 0;
  static constexpr auto fields() { return describe(field<&Pose::x>()); }
#endif
};

struct LAW {
  static constexpr std::string_view summary = "for tests";
  struct Out {
    Pose pose;
    static constexpr auto fields() { return describe(field<&Out::pose>()); }
  };
  static void run(const Tick& tick, Out& out) { out.pose.x = Gains::table[tick.activation % 4]; }
};

JAROL_PLUGIN(LAW)
