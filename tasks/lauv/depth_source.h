// How deep the submarine is by the best of what reports it: the depth gauge, the pressure of the CTD, and GPS, which
// finds the surface.
#pragma once

#include <cstdint>

#include "tasks/values/instruments.h"

namespace jarol::tasks {

/// In m below the surface of fresh water, from a pressure in hPa.
double calc_depth(double pressure);

/// The gauge, while it reports; then the pressure. Where they differ too much, the deeper one. Fixes of GPS come from
/// the surface: a reading that is deeper beside three of them is wrong, until a fix agrees with it; but not where gauge
/// and pressure agree, and, where nothing shows a smaller depth, only while fixes go on: one that was late, or
/// another's, takes no submarine for surfaced. While neither depth is known it stays where it was last, or at the
/// surface once there are three fixes in a row.
struct DepthSource {
  struct Model {
    double timeout;                      // s
    double error, fix_depth, fix_error;  // m
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
