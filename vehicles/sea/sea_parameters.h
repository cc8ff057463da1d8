// Parameters of the sea.
#pragma once

#include "graph/math/geometry.h"
#include "graph/values/type_of.h"

namespace jarol::vehicles {

/// Where an acoustic transponder lies.
struct BeaconParameters {
  double north = 0.0;
  double east = 0.0;
  double depth = 0.0;

  static constexpr auto fields() {
    using S = BeaconParameters;
    return describe(field<&S::north>("m", "offset north of the origin"),
                    field<&S::east>("m", "offset east of the origin"), field<&S::depth>("m", "below the surface"));
  }
};

struct BeaconsParameters {
  BeaconParameters first{-30.0, -60.0, 10.0};
  BeaconParameters second{130.0, -60.0, 10.0};
  double reach = 500.0;

  static constexpr auto fields() {
    using S = BeaconsParameters;
    return describe(field<&S::first>("", "one of them"), field<&S::second>("", "the other"),
                    field<&S::reach>("m", "greatest range at which they answer; 0: there are none"));
  }
};

/// The current is the same at all depths and carries the waves along, so that the motion through the water does not
/// depend on it.
struct SeaParameters {
  double gravity = 9.81;
  double density = 1000.0;
  double temperature = 14.0;
  double salinity = 35.0;
  double current_north = 0.0;
  double current_east = 0.0;
  double wave_height = 0.0;
  double wave_period = 5.0;
  double wave_direction = 0.0;
  double floor = 50.0;
  double latitude = 41.1850 * degree;
  double longitude = -8.7062 * degree;
  BeaconsParameters beacons{};

  static constexpr auto fields() {
    using S = SeaParameters;
    return describe(
        field<&S::gravity>("m/s^2", "acceleration of gravity"), field<&S::density>("kg/m^3", "of the water"),
        field<&S::temperature>("degC", "of the water"), field<&S::salinity>("", "practical salinity"),
        field<&S::current_north>("m/s", "current to the north"), field<&S::current_east>("m/s", "current to the east"),
        field<&S::wave_height>("m", "of the waves, crest to trough"),
        field<&S::wave_period>("s", "from crest to crest"),
        field<&S::wave_direction>("rad", "to which the waves run, clockwise from north"),
        field<&S::floor>("m", "depth of the sea floor"), field<&S::latitude>("rad", "latitude of the origin (WGS-84)"),
        field<&S::longitude>("rad", "longitude of the origin"), field<&S::beacons>("", "acoustic transponders"));
  }
};

}  // namespace jarol::vehicles
