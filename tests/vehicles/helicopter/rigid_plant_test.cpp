// One rigid body against Simbody, over whatever the helicopter may be told to do.
#include "vehicles/helicopter/rigid_plant.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "vehicles/helicopter/helicopter.h"

namespace {
using namespace jarol::vehicles;

double between(std::mt19937_64& random, double min, double greatest) {
  return min + (greatest - min) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// In any air, with what it drops and with motors that fail.
HelicopterParameters any_parameters(std::mt19937_64& random) {
  HelicopterParameters parameters;
  parameters.air.north = between(random, -5, 5);
  parameters.air.east = between(random, -5, 5);
  parameters.air.gusts = between(random, 0, 1);
  parameters.air.dryden = random() % 2 == 0;
  parameters.payload = {.mass = between(random, 0, 0.5), .at = between(random, 0, 10)};
  if (random() % 2 == 0)
    parameters.failures.right = {.kind = ActuatorFailureKind::weak, .at = between(random, 0, 10), .by = 0.7};
  return parameters;
}

VehicleState any_start(std::mt19937_64& random, double height, double tilt, double speed) {
  const auto up_to = [&](double max) { return between(random, -max, max); };
  return {up_to(5),     up_to(5),     -height,      up_to(tilt),  up_to(tilt),  up_to(3.1),
          up_to(speed), up_to(speed), up_to(speed), up_to(speed), up_to(speed), up_to(speed)};
}

HelicopterInputs any_command(std::mt19937_64& random, double min, double greatest) {
  const double mean = between(random, min, greatest);
  const auto signal = [&] { return std::clamp(mean + between(random, -300, 300), 0.0, 16000.0); };
  return {signal(), signal(), signal(), signal()};
}

// How far a flight is from the same one in Simbody.
struct Apart {
  double place = 0, angle = 0, rate = 0;

  void print() const { MESSAGE("at most " << place << " m, " << angle << " rad, " << rate << " m/s or rad/s apart"); }

  // So many steps, with another command every so many.
  template <class Command>
  void fly(HelicopterParameters parameters, std::uint64_t seed, const VehicleState& start, int steps, int every,
           const Command& command) {
    CAPTURE(seed);
    Helicopter simbody(parameters, seed);
    parameters.dynamics = Dynamics::rigid;
    Helicopter rigid(parameters, seed);
    simbody.place(start);
    rigid.place(start);
    for (int i = 0; i < steps; ++i) {
      if (i % every == 0) {
        const HelicopterInputs inputs = command();
        simbody.command(&inputs);
        rigid.command(&inputs);
      }
      simbody.step();
      rigid.step();
      compare(simbody.motion(), rigid.motion());
    }
  }

  void compare(const HelicopterMotion& a, const HelicopterMotion& b) {
    for (std::size_t i = 0; i < 3; ++i) {
      place = std::max(place, std::abs(a.p_n[i] - b.p_n[i]));
      rate = std::max({rate, std::abs(a.v_b[i] - b.v_b[i]), std::abs(a.omega_b[i] - b.omega_b[i])});
      for (std::size_t j = 0; j < 3; ++j) angle = std::max(angle, std::abs(a.R_nb[i][j] - b.R_nb[i][j]));
    }
  }
};
}  // namespace

TEST_SUITE("vehicles/helicopter_rigid_plant") {
  TEST_CASE("twenty seconds of any commands in any air go as Simbody's do, but for rounding") {
    Apart apart;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      std::mt19937_64 random(seed);
      const HelicopterParameters parameters = any_parameters(random);
      const VehicleState start = any_start(random, 3000, 3, 3);
      apart.fly(parameters, seed, start, 4000, 40, [&] { return any_command(random, 0, 16000); });
    }
    apart.print();
    CHECK(apart.place < 1e-9);
    CHECK(apart.angle < 1e-9);
    CHECK(apart.rate < 1e-8);
  }

  TEST_CASE("dropped, driven along and lifted off again it goes as in Simbody, but for rounding") {
    Apart apart;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      std::mt19937_64 random(seed);
      HelicopterParameters parameters = any_parameters(random);
      parameters.failures.right = {};
      const VehicleState start = any_start(random, 0.7, 0.3, 0.3);
      apart.fly(parameters, seed, start, 1000, 100, [&] { return any_command(random, 3000, 8300); });
    }
    apart.print();
    CHECK(apart.place < 1e-8);
    CHECK(apart.angle < 1e-8);
    CHECK(apart.rate < 1e-6);
  }

  TEST_CASE("a state that is not finite is reported with its time, and stays so") {
    HelicopterParameters parameters;
    parameters.dynamics = Dynamics::rigid;
    Helicopter helicopter(parameters);
    VehicleState start;
    start.z = -100;
    start.u = 1e200;
    helicopter.place(start);
    for (int i = 0; i < 2; ++i)
      CHECK_THROWS_WITH_AS(helicopter.step(), "helicopter: no state at t = 0.005000 s: a number in it is not finite",
                           NoState);
  }

  TEST_CASE("a motion that its model is not made for ends it, instead of being followed to the stars") {
    HelicopterParameters parameters;
    parameters.dynamics = Dynamics::rigid;
    Helicopter helicopter(parameters);
    VehicleState start;
    start.z = -1000;
    start.u = 339;
    helicopter.place(start);
    helicopter.step();
    start.u = 5000;
    helicopter.place(start);
    for (int i = 0; i < 2; ++i)
      CHECK_THROWS_WITH_AS(
          helicopter.step(),
          "helicopter: no state at t = 0.005000 s: it moves at 3821 m/s, which this model of it is not made for",
          NoState);
  }
}
