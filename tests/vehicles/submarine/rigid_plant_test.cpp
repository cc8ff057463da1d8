// One rigid body against Simbody, over whatever the submarine may be told to do.
#include "vehicles/submarine/rigid_plant.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "graph/text/errors.h"
#include "vehicles/submarine/submarine.h"

namespace {
using namespace jarol::vehicles;

double between(std::mt19937_64& random, double min, double greatest) {
  return min + (greatest - min) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// In any sea, from any depth; the floor is far below.
SubmarineParameters any_sea(std::mt19937_64& random) {
  SubmarineParameters parameters;
  SeaParameters& sea = parameters.sea;
  sea.current_north = between(random, -0.5, 0.5);
  sea.current_east = between(random, -0.5, 0.5);
  if (random() % 2 == 0) {
    sea.wave_height = between(random, 0.0, 1.5);
    sea.wave_period = between(random, 5.0, 10.0);
    sea.wave_direction = between(random, -3.0, 3.0);
  }
  parameters.start.depth = between(random, 0.0, 10.0);
  parameters.start.heading = between(random, -3.1, 3.1);
  parameters.start.surge = between(random, 0.0, 1.5);
  return parameters;
}

SubmarineInputs any_command(std::mt19937_64& random) {
  const auto fin = [&] { return between(random, -0.4, 0.4); };
  return {between(random, -0.3, 1.0), fin(), fin(), fin(), fin()};
}
}  // namespace

TEST_SUITE("vehicles/rigid_plant") {
  TEST_CASE("a minute of any commands in any sea ends where Simbody's does, but for rounding") {
    double apart = 0, turned = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      CAPTURE(seed);
      std::mt19937_64 random(seed);
      SubmarineParameters parameters = any_sea(random);
      Submarine simbody(parameters, seed);
      parameters.dynamics = Dynamics::rigid;
      Submarine rigid(parameters, seed);
      for (int i = 0; i < 6000; ++i) {
        if (i % 200 == 0) {
          const SubmarineInputs inputs = any_command(random);
          simbody.command(&inputs);
          rigid.command(&inputs);
        }
        simbody.step();
        rigid.step();
      }
      const VehicleState a = simbody.state(), b = rigid.state();
      apart = std::max(apart, std::hypot(a.x - b.x, a.y - b.y, a.z - b.z));
      for (const double difference : {a.phi - b.phi, a.theta - b.theta, a.psi - b.psi})
        turned = std::max(turned, std::abs(std::remainder(difference, 2 * 3.14159265358979)));
    }
    MESSAGE("at most " << apart << " m and " << turned << " rad apart");
    CHECK(apart < 1e-9);
    CHECK(turned < 1e-10);
  }

  TEST_CASE("a state that is not finite is reported with its time, and stays so") {
    SubmarineParameters parameters;
    parameters.dynamics = Dynamics::rigid;
    Submarine submarine(parameters);
    VehicleState start;
    start.u = 1e200;
    submarine.place(start);
    CHECK_THROWS_WITH_AS(submarine.step(), "submarine: no state at t = 0.010000 s: a number in it is not finite",
                         NoState);
    CHECK_THROWS_WITH_AS(submarine.step(), "submarine: no state at t = 0.020000 s: a number in it is not finite",
                         NoState);
  }

  TEST_CASE("VSIM's plant has dynamics of its own") {
    SubmarineParameters parameters;
    parameters.vsim_compatible = true;
    parameters.dynamics = Dynamics::rigid;
    CHECK_THROWS_WITH_AS(Submarine{parameters},
                         "submarine: with vsim_compatible it has dynamics of its own; leave dynamics out",
                         jarol::InputError);
  }
}
