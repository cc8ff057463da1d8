// What goes into the helicopter and comes out of it.
#pragma once

#include <vector>

#include "graph/values/describe.h"
#include "vehicles/vehicle.h"

namespace jarol::vehicles {

struct HelicopterInputs {
  double front = 0.0;
  double right = 0.0;
  double rear = 0.0;
  double left = 0.0;

  static std::vector<Range> ranges() {
    constexpr Range signal{0, 16000};
    return {signal, signal, signal, signal};
  }

  static constexpr auto fields() {
    using S = HelicopterInputs;
    return describe(field<&S::front>("", "motor signal, front rotor"),
                    field<&S::right>("", "motor signal, right rotor"), field<&S::rear>("", "motor signal, rear rotor"),
                    field<&S::left>("", "motor signal, left rotor"));
  }
};

/// Signals that the rotors have reached at the reference voltage.
struct HelicopterRotors {
  double front = 0.0;
  double right = 0.0;
  double rear = 0.0;
  double left = 0.0;

  static constexpr auto fields() {
    using S = HelicopterRotors;
    return describe(field<&S::front>("", "signal that the front rotor has reached, 0 to 16000"),
                    field<&S::right>("", "the same of the right rotor"),
                    field<&S::rear>("", "the same of the rear rotor"),
                    field<&S::left>("", "the same of the left rotor"));
  }
};

struct HelicopterBattery {
  double voltage = 0.0;
  double current = 0.0;

  static constexpr auto fields() {
    using S = HelicopterBattery;
    return describe(field<&S::voltage>("V", "voltage of the battery"), field<&S::current>("A", "drawn from it"));
  }
};

struct HelicopterOutputs {
  HelicopterRotors rotors{};
  HelicopterBattery battery{};

  static constexpr auto fields() {
    using S = HelicopterOutputs;
    return describe(field<&S::rotors>("", "what the rotors do"), field<&S::battery>("", "what the battery gives"));
  }
};

}  // namespace jarol::vehicles
