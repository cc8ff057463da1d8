// Motors and payload of a helicopter as they fail, at a time or by chance.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "vehicles/helicopter/coefficients.h"
#include "vehicles/helicopter/helicopter.h"

namespace {
using namespace jarol::vehicles;

// Settings reached after so many seconds with all motor signals at 8000, high in the air.
HelicopterRotors rotors_after(const HelicopterParameters& parameters, double seconds, std::uint64_t seed = 0) {
  Helicopter helicopter(parameters, seed);
  const HelicopterInputs hover{8000, 8000, 8000, 8000};
  for (int i = 0; i < seconds / 0.005; ++i) {
    helicopter.command(&hover);
    helicopter.step();
  }
  return static_cast<const HelicopterOutputs*>(helicopter.outputs())->rotors;
}

HelicopterParameters flying() {
  HelicopterParameters parameters;
  parameters.start.altitude = 100;
  parameters.start.signal = 8000;
  return parameters;
}

std::vector<double> begins(double chance) {
  std::vector<double> all;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) all.push_back(draw_begin(5, chance, seed));
  return all;
}
}  // namespace

TEST_SUITE("vehicles/helicopter_failures") {
  TEST_CASE("a motor that goes hard over turns at full speed, or at a part of it, never backwards") {
    HelicopterParameters parameters = flying();
    parameters.failures.front = {.kind = ActuatorFailureKind::hardover, .at = 0.1};
    parameters.failures.right = {.kind = ActuatorFailureKind::hardover, .at = 0.1, .to = 0.5};
    parameters.failures.rear = {.kind = ActuatorFailureKind::hardover, .at = 0.1, .to = -1};
    const HelicopterRotors reached = rotors_after(parameters, 1);
    CHECK(reached.front > 1.9 * reached.right);
    CHECK(reached.front < 2.1 * reached.right);
    CHECK(reached.front > 12'000);
    CHECK(reached.rear < 1);
  }

  TEST_CASE("a motor that is lost stands, one that is weak gives its part of the thrust, one that is stuck turns on") {
    HelicopterParameters parameters = flying();
    parameters.failures.front = {ActuatorFailureKind::lost, 0.1};
    parameters.failures.right = {ActuatorFailureKind::weak, 0.1, 0.5};
    const HelicopterRotors reached = rotors_after(parameters, 1);
    CHECK(reached.front < 1);
    CHECK(std::pow(reached.right / reached.left, parameters.rotors.thrust_exponent) == doctest::Approx(0.5));

    parameters.failures.rear = {ActuatorFailureKind::stuck, 0.1};
    Helicopter helicopter(parameters);
    HelicopterInputs inputs{8000, 8000, 8000, 8000};
    for (int i = 0; i < 100; ++i) {
      if (i == 50) inputs = {0, 0, 0, 0};
      helicopter.command(&inputs);
      helicopter.step();
    }
    const auto& rotors = static_cast<const HelicopterOutputs*>(helicopter.outputs())->rotors;
    CHECK(rotors.rear == doctest::Approx(8000).scale(0).epsilon(0.03));
    CHECK(rotors.left < 100);
  }

  TEST_CASE("what begins by chance begins so much later in the mean, as late as each seed says") {
    double sum = 0;
    for (const double begin : begins(0.5)) {
      CHECK(begin > 5);
      sum += begin - 5;
    }
    CHECK(sum / 2000 == doctest::Approx(2).scale(0).epsilon(0.05));
    CHECK(begins(0.5) == begins(0.5));
    CHECK(begins(0).front() == 5);
  }

  TEST_CASE("a payload that is dropped leaves it too much thrust: at hover with it, m/M of a g upwards") {
    HelicopterParameters parameters = flying();
    parameters.payload = {.mass = 0.3, .at = 0.5};
    parameters.frame.drag_area = parameters.rotors.inflow = parameters.battery.resistance = 0;
    parameters.battery.full = parameters.battery.empty = parameters.rotors.reference_voltage;
    const double signal = 16000 * std::pow(1.8 * 9.81 / 4 / 9.81, 1 / parameters.rotors.thrust_exponent);
    parameters.start.signal = signal;
    Helicopter helicopter(parameters);
    const HelicopterInputs hover{signal, signal, signal, signal};
    const auto speed_after = [&](int steps) {
      for (int i = 0; i < steps; ++i) {
        helicopter.command(&hover);
        helicopter.step();
      }
      return -helicopter.motion().v_b[2];
    };
    const double before = speed_after(100);
    CHECK(std::abs(before) < 0.01);  // the signal is a whole number
    CHECK(speed_after(100) - before == doctest::Approx(0.5 * 9.81 * 0.3 / 1.5).scale(0).epsilon(0.02));
  }

  TEST_CASE("a payload that may be dropped from the start on is carried until then, and the feet bear it") {
    HelicopterParameters parameters;
    parameters.payload = {.mass = 0.5, .at = 0, .chance = 0.5};
    const double empty = make_start({}).p_n[2];
    CHECK(make_body(parameters).payload == 0.5);
    CHECK(make_start(parameters).p_n[2] - empty == doctest::Approx(0.5 * 9.81 / (4 * 2500)));
    parameters.payload.chance = 0;
    CHECK(make_body(parameters).payload == 0);
    CHECK(make_start(parameters).p_n[2] == empty);
  }

  TEST_CASE("on its back it lies on rotors and top, not on its feet") {
    Helicopter helicopter{HelicopterParameters{}};
    helicopter.place({.z = -0.3, .phi = 3.0});
    for (int i = 0; i < 1000; ++i) helicopter.step();
    CHECK(std::abs(std::remainder(helicopter.state().phi, 6.283185307)) > 2.9);
    CHECK(helicopter.state().z == doctest::Approx(-0.12).scale(0).epsilon(0.1));  // its top
    CHECK(helicopter.mishap().has_value());
  }
}
