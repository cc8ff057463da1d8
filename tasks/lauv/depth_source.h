// How deep the submarine is by the best of what reports it: the depth gauge, the pressure of the CTD, and GPS, which
// finds the surface.
#pragma once

#include <cstdint>

#include "tasks/values/instruments.h"

namespace jarol::tasks {

/// What makes a depth of a pressure.
struct Water {
  double density = 1000;
  double air_pressure = 1013.25;

  static constexpr auto fields() {
    return describe(field<&Water::density>("kg/m^3", "of the water; of the sea some 1025").in(500, 2000),
                    field<&Water::air_pressure>("hPa", "at the surface").in(0, 2000));
  }
};

/// In m below the surface, from a pressure in hPa: 100 (pressure - air_pressure) / (density g).
double calc_depth(const Water& water, double pressure);

/// The gauge, while it reports; then the pressure. Where they differ too much, the deeper one. Fixes of GPS come from
/// the surface: a reading that is deeper beside `enough` of them is wrong, until a fix agrees with it; but not where
/// gauge and pressure agree, and, where nothing shows a smaller depth, only while fixes go on: one that was late, or
/// another's, takes no submarine for surfaced. While neither depth is known it stays where it was last, or at the
/// surface once there are `enough` fixes in a row.
struct DepthSource {
  struct Model {
    double timeout;                      // s
    double error, fix_depth, fix_error;  // m
    std::int64_t enough;                 // fixes
    Water water;
  };
  struct Gauge {
    std::int64_t count = 0;
    double silence = 0;
    std::int64_t contradicted = 0;
    static constexpr auto fields() {
      using G = Gauge;
      return describe(field<&G::count>("", "readings so far"), field<&G::silence>("s", "since the last one"),
                      field<&G::contradicted>("",
                                              "fixes beside which it was deeper than where GPS works, since one "
                                              "agreed"));
    }
  };
  Gauge gauge{}, pressure{};
  std::int64_t fixes = 0, fixes_in_row = 0;
  double since_fix = 0;
  double depth = 0;
  static constexpr auto fields() {
    using S = DepthSource;
    return describe(field<&S::gauge>(), field<&S::pressure>(), field<&S::fixes>("", "of GPS, so far"),
                    field<&S::fixes_in_row>("", "none missed between them"),
                    field<&S::since_fix>("s", "since the last one"), field<&S::depth>("m", "by the best source"));
  }

  void take(const Model& model, const Instruments& instruments, double dt);
};

}  // namespace jarol::tasks
