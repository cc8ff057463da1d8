// Parameters of the air that a helicopter flies in.
#pragma once

#include "graph/values/describe.h"

namespace jarol::vehicles {

/// One gust: it comes and goes as 1 - cos does, on top of the other wind.
struct GustParameters {
  double north = 0.0;
  double east = 0.0;
  double down = 0.0;
  double at = 0.0;
  double chance = 0.0;
  double time = 1.0;

  static constexpr auto fields() {
    using S = GustParameters;
    return describe(field<&S::north>("m/s", "greatest, to the north"), field<&S::east>("m/s", "to the east"),
                    field<&S::down>("m/s", "downwards"), field<&S::at>("s", "when it begins, or may begin"),
                    field<&S::chance>("1/s", "rate at which it begins from then on; 0: it begins then"),
                    field<&S::time>("s", "that it lasts"));
  }
};

/// Mean wind, over rough ground less near it, and gusts: a random walk that tends back to the mean, alike in all three
/// axes, or one of the Dryden model.
struct AirParameters {
  double density = 1.225;
  double gravity = 9.81;
  double north = 0.0;
  double east = 0.0;
  double down = 0.0;
  double gusts = 0.0;
  double gust_time = 1.0;
  bool dryden = false;
  double roughness = 0.0;
  double wind_height = 10.0;
  GustParameters gust{};

  static constexpr auto fields() {
    using S = AirParameters;
    return describe(field<&S::density>("kg/m^3", "density of air"),
                    field<&S::gravity>("m/s^2", "acceleration of gravity"),
                    field<&S::north>("m/s", "mean wind to the north"), field<&S::east>("m/s", "mean wind to the east"),
                    field<&S::down>("m/s", "mean wind downwards"),
                    field<&S::gusts>("m/s", "standard deviation of the gusts, per axis"),
                    field<&S::gust_time>("s", "over which gusts stay alike"),
                    field<&S::dryden>("", "across the wind and vertical gusts are of the Dryden model's second order"),
                    field<&S::roughness>("m", "of the ground, for a wind that grows with height; 0: it does not"),
                    field<&S::wind_height>("m", "at which the mean wind is as given, over rough ground"),
                    field<&S::gust>("", "one more, at a time or by chance"));
  }
};

}  // namespace jarol::vehicles
