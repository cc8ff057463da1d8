// How deep the submarine is by the best of what reports it: the depth gauge, the pressure of the CTD, and GPS, which
// finds the surface.
#pragma once

#include <cstdint>

#include "tasks/values/instruments.h"

namespace jarol::tasks {

/// In m below the surface of fresh water, from a pressure in hPa.
double calc_depth(double pressure);

/// The gauge, while it reports; then the pressure. Where they differ too much, the deeper one. A fix of GPS comes from
/// the surface alone: a reading that is deeper then is wrong, until a fix agrees with it. While neither is known it
/// stays where it was last, or at the surface once there is a fix.
struct DepthSource {
  struct Model {
    double timeout;                      // s
    double error, fix_depth, fix_error;  // m
  };
  struct Gauge {
    std::int64_t count = 0;
    double silence = 0;
    bool wrong = false;
    static constexpr auto fields() {
      using G = Gauge;
      return describe(field<&G::count>("", "readings so far"), field<&G::silence>("s", "since the last one"),
                      field<&G::wrong>("", "deeper than where GPS works, as of the last fix"));
    }
  };
  Gauge gauge{}, pressure{};
  std::int64_t fixes = 0;
  double depth = 0;
  static constexpr auto fields() {
    using S = DepthSource;
    return describe(field<&S::gauge>(), field<&S::pressure>(), field<&S::fixes>("", "of GPS, so far"),
                    field<&S::depth>("m", "by the best source"));
  }

  void take(const Model& model, const Instruments& instruments, double dt);
};

}  // namespace jarol::tasks
