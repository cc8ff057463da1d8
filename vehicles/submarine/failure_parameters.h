// How the submarine's fins and propeller fail.
#pragma once

#include "vehicles/mechanics/actuator_failure.h"

namespace jarol::vehicles {

struct ActuatorFailureParameters {
  ActuatorFailure fin0{};
  ActuatorFailure fin1{};
  ActuatorFailure fin2{};
  ActuatorFailure fin3{};
  ActuatorFailure propeller{};

  static constexpr auto fields() {
    using S = ActuatorFailureParameters;
    return describe(field<&S::fin0>("", "the bottom rudder"), field<&S::fin1>("", "the port elevator"),
                    field<&S::fin2>("", "the starboard elevator"), field<&S::fin3>("", "the top rudder"),
                    field<&S::propeller>("", "the propeller"));
  }
};

}  // namespace jarol::vehicles
