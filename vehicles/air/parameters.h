// Parameters of the air that a helicopter flies in.
#pragma once

#include "graph/values/describe.h"

namespace jarol::vehicles {

/// Mean wind and gusts: a random walk that tends back to the mean, alike in all three axes.
struct AirParameters {
  double density = 1.225;
  double gravity = 9.81;
  double north = 0.0;
  double east = 0.0;
  double down = 0.0;
  double gusts = 0.0;
  double gust_time = 1.0;

  static constexpr auto fields() {
    using S = AirParameters;
    return describe(field<&S::density>("kg/m^3", "density of air"),
                    field<&S::gravity>("m/s^2", "acceleration of gravity"),
                    field<&S::north>("m/s", "mean wind to the north"), field<&S::east>("m/s", "mean wind to the east"),
                    field<&S::down>("m/s", "mean wind downwards"),
                    field<&S::gusts>("m/s", "standard deviation of the gusts, per axis"),
                    field<&S::gust_time>("s", "over which gusts stay alike"));
  }
};

}  // namespace jarol::vehicles
