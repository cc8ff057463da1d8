// The plant against a second model of the same submarine, and against what physics demands of both.
#include "vehicles/submarine_plant.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/vehicles/submarine_oracle.h"
#include "vehicles/hydrostatics.h"
#include "vehicles/submarine_coefficients.h"

namespace {
using namespace jarol::vehicles;

constexpr double angle = std::numbers::pi / 180;

PlantState deep(double surge) {
  PlantState start;
  start.eta[2] = 20;
  start.nu[0] = surge;
  return start;
}

// Thrust and fins of a smooth minute: a dive, a turn to either side, more and less thrust.
SubmarineInput minute(double time) {
  SubmarineInput input;
  input.thrust = time < 20 ? 6 : time < 40 ? 9 : 4;
  const double elevator = time < 10 ? 0 : time < 15 ? 4 * angle : time < 25 ? -3 * angle : 0;
  const double rudder = time < 20 ? 0 : time < 35 ? -10 * angle : 6 * angle;
  input.fins = {rudder, elevator, elevator, rudder};
  return input;
}

// Energy of the moving hull and the water that moves with it.
double kinetic_energy(const SubmarineBody& body, const PlantState& state) {
  fossen::Vector6 nu{};
  for (std::size_t i = 0; i < 6; ++i) nu[i] = state.nu[i];
  const fossen::Vector6 rigid = fossen::multiply(body.M_rb, nu), added = fossen::multiply(body.M_a, nu);
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) sum += nu[i] * (rigid[i] + added[i]) / 2;
  return sum;
}
}  // namespace

TEST_SUITE("vehicles/submarine_plant") {
  TEST_CASE("after a minute of dives and turns it stands within a millionth of the way where the oracle stands") {
    const SubmarineParameters parameters;
    SubmarinePlant plant(make_body(parameters), deep(1.0));
    jarol::test::SubmarineOracle oracle(parameters, 20, 1.0);
    double way = 0, worst = 0;
    Eigen::Vector3d last(0, 0, 20);
    for (int i = 0; i < 6000; ++i) {
      const SubmarineInput input = minute(0.01 * i);
      plant.step(input);
      oracle.advance(0.01, input.thrust, input.fins);
      way += (oracle.position() - last).norm();
      last = oracle.position();
      const PlantState state = plant.state();
      worst = std::max(worst, (Eigen::Vector3d(state.eta[0], state.eta[1], state.eta[2]) - last).norm());
    }
    MESSAGE("way " << way << " m, largest deviation " << worst << " m");
    CHECK(way > 40);
    CHECK(worst < 1e-6 * way);
  }

  TEST_CASE("the same inputs give the same bits") {
    const SubmarineBody body = make_body({});
    SubmarinePlant one(body, deep(1)), two(body, deep(1));
    for (int i = 0; i < 500; ++i) {
      one.step(minute(0.1 * i));
      two.step(minute(0.1 * i));
      if (i % 7 == 0) static_cast<void>(two.state());  // looking changes nothing
    }
    for (std::size_t i = 0; i < 6; ++i) {
      CHECK(one.state().eta[i] == two.state().eta[i]);
      CHECK(one.state().nu[i] == two.state().nu[i]);
    }
  }

  TEST_CASE("left alone in the water it loses kinetic energy at every step") {
    SubmarineParameters parameters;
    parameters.hull.z_g = 0;
    parameters.hull.buoyancy = parameters.hull.mass * parameters.sea.gravity;  // no potential energy to be had
    const SubmarineBody body = make_body(parameters);
    PlantState start = deep(1.5);
    start.nu[1] = 0.3;
    start.nu[2] = -0.2;
    start.nu[3] = 0.5;
    start.nu[4] = 0.2;
    start.nu[5] = -0.3;
    SubmarinePlant plant(body, start);
    double energy = kinetic_energy(body, start);
    for (int i = 0; i < 2000; ++i) {
      plant.step({});
      const double now = kinetic_energy(body, plant.state());
      REQUIRE(now < energy);
      energy = now;
    }
    CHECK(energy < 0.5);
  }

  TEST_CASE("in straight deep run the terminal speed is that at which drag equals thrust") {
    SubmarineParameters parameters;
    parameters.hull.z_g = 0;
    parameters.hull.buoyancy = parameters.hull.mass * parameters.sea.gravity;
    SubmarinePlant plant(make_body(parameters), deep(1));
    SubmarineInput input;
    input.thrust = 8;
    for (int i = 0; i < 12000; ++i) plant.step(input);
    // 2.4 u + 2.4 u^2 = 8
    const double expected = (-2.4 + std::sqrt(2.4 * 2.4 + 4 * 2.4 * 8)) / (2 * 2.4);
    CHECK(plant.state().nu[0] == doctest::Approx(expected).epsilon(1e-6));
  }

  TEST_CASE("at rest it floats where its buoyancy carries its weight") {
    const SubmarineBody body = make_body({});
    PlantState start;
    start.eta[2] = calc_floating_depth(body.hull);
    SubmarinePlant plant(body, start);
    for (int i = 0; i < 1000; ++i) plant.step({});
    CHECK(std::abs(plant.state().eta[2] - start.eta[2]) < 1e-9);
    CHECK(std::abs(plant.state().nu[2]) < 1e-9);
  }

  TEST_CASE("deep down the surplus of buoyancy carries it up") {
    SubmarinePlant plant(make_body({}), deep(0));
    for (int i = 0; i < 500; ++i) plant.step({});
    CHECK(plant.state().eta[2] < 20);
    CHECK(plant.state().nu[2] < 0);
  }
}
