// The plant, in Simbody and as one rigid body, against a second model of the same submarine, and against what physics
// demands of both.
#include "vehicles/submarine/plant.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/vehicles/submarine_oracle.h"
#include "vehicles/sea/hydrostatics.h"
#include "vehicles/submarine/coefficients.h"
#include "vehicles/submarine/rigid_plant.h"

namespace {
using namespace jarol::vehicles;

constexpr double angle = std::numbers::pi / 180;

PlantState at(double depth, double surge) {
  PlantState start;
  start.eta[2] = depth;
  start.nu[0] = surge;
  return start;
}

PlantState deep(double surge) { return at(20, surge); }

// Propeller and fins of a smooth minute: a dive, a turn to either side, more and less thrust.
SubmarineInput minute(double time) {
  SubmarineInput input;
  input.propeller = time < 20 ? 170 : time < 40 ? 210 : 140;
  const double elevator = time < 10 ? 0 : time < 15 ? 4 * angle : time < 25 ? -3 * angle : 0;
  const double rudder = time < 20 ? 0 : time < 35 ? -10 * angle : 6 * angle;
  input.fins = {rudder, elevator, elevator, rudder};
  return input;
}

// Energy of the moving hull and the water that moves with it.
double kinetic_energy(const SubmarineBody& body, const PlantState& state) {
  const fossen::Vector6& nu = state.nu;
  const fossen::Vector6 rigid = fossen::multiply(body.M_rb, nu), added = fossen::multiply(body.M_a, nu);
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) sum += nu[i] * (rigid[i] + added[i]) / 2;
  return sum;
}
}  // namespace

TEST_SUITE("vehicles/submarine_plant") {
  TEST_CASE_TEMPLATE(
      "after a minute of dives and turns it stands within a millionth of the way where the oracle stands", Plant,
      SubmarinePlant, RigidSubmarine) {
    SubmarineParameters parameters;
    double depth = 20;
    SUBCASE("in still water") {}
    SUBCASE("at the surface") { depth = 0.05; }
    SUBCASE("in a current, in waves, in salt water, with a propeller that loses thrust ahead") {
      parameters.sea.current_north = 0.3;
      parameters.sea.current_east = -0.2;
      parameters.sea.wave_height = 1.5;
      parameters.sea.wave_period = 8;
      parameters.sea.wave_direction = 1;
      parameters.sea.density = 1025;
      parameters.hull.mass = 18.4;
      parameters.added_mass.Z_q_dot = parameters.added_mass.Y_r_dot = 0.4;
      parameters.thruster.advance_coefficient = 0.01;
    }
    const SeaParameters& sea = parameters.sea;
    Plant plant(make_body(parameters), Waves(sea.wave_height, sea.wave_period, sea.wave_direction), at(depth, 1.0));
    jarol::test::SubmarineOracle oracle(parameters, depth, 1.0);
    double way = 0, worst = 0;
    Eigen::Vector3d last(0, 0, depth);
    for (int i = 0; i < 6000; ++i) {
      const SubmarineInput input = minute(0.01 * i);
      plant.step(input);
      oracle.advance(0.01, input.propeller, input.fins);
      way += (oracle.position() - last).norm();
      last = oracle.position();
      // the plant reports its place in the water that the current carries along
      const PlantState state = plant.state();
      const double t = 0.01 * (i + 1);
      const Eigen::Vector3d place(state.eta[0] + sea.current_north * t, state.eta[1] + sea.current_east * t,
                                  state.eta[2]);
      worst = std::max(worst, (place - last).norm());
    }
    MESSAGE("way " << way << " m, largest deviation " << worst << " m");
    CHECK(way > 40);
    CHECK(worst < 1e-6 * way);
  }

  TEST_CASE_TEMPLATE("the same inputs give the same bits", Plant, SubmarinePlant, RigidSubmarine) {
    const SubmarineBody body = make_body({});
    Plant one(body, {}, deep(1)), two(body, {}, deep(1));
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

  TEST_CASE_TEMPLATE("left alone in the water it loses kinetic energy at every step", Plant, SubmarinePlant,
                     RigidSubmarine) {
    SubmarineParameters parameters;
    parameters.hull.z_g = 0;
    parameters.hull.buoyancy = parameters.hull.mass * parameters.sea.gravity;  // no potential energy to be had
    const SubmarineBody body = make_body(parameters);
    PlantState start = deep(1.5);
    start.nu = {1.5, 0.3, -0.2, 0.5, 0.2, -0.3};
    Plant plant(body, {}, start);
    double energy = kinetic_energy(body, start);
    for (int i = 0; i < 2000; ++i) {
      plant.step({});
      const double now = kinetic_energy(body, plant.state());
      REQUIRE(now < energy);
      energy = now;
    }
    CHECK(energy < 0.5);
  }

  TEST_CASE_TEMPLATE("without damping it keeps its energy", Plant, SubmarinePlant, RigidSubmarine) {
    SubmarineParameters parameters;
    parameters.linear_damping = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    parameters.quadratic_damping = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    parameters.lift = {0, 0, 0, 0, 0, 0, 0, 0};
    parameters.added_mass.Y_r_dot = parameters.added_mass.Z_q_dot = 0.5;
    const SubmarineBody body = make_body(parameters);
    PlantState start = deep(1.5);
    start.nu = {1.5, 0.3, -0.2, 0.5, 0.2, -0.3};
    // that of height: weight at its own centre, buoyancy at the origin
    const auto energy = [&](const PlantState& s) {
      const double down = std::cos(s.eta[3]) * std::cos(s.eta[4]);
      return kinetic_energy(body, s) - body.hull.W * (s.eta[2] + body.hull.r_bg[2] * down) + body.hull.B * s.eta[2];
    };
    Plant plant(body, {}, start);
    for (int i = 0; i < 1500; ++i) plant.step({});
    CHECK(plant.state().eta[2] < 48);  // clear of the floor
    CHECK(std::abs(energy(plant.state()) - energy(start)) < 1e-6 * kinetic_energy(body, start));
  }

  TEST_CASE_TEMPLATE("neutrally buoyant and at rest it stays where it is", Plant, SubmarinePlant, RigidSubmarine) {
    SubmarineParameters parameters;
    parameters.hull.buoyancy = parameters.hull.mass * parameters.sea.gravity;
    Plant plant(make_body(parameters), {}, deep(0));
    for (int i = 0; i < 6000; ++i) plant.step({});
    for (std::size_t i = 0; i < 6; ++i) CHECK(plant.state().nu[i] == 0);
    CHECK(plant.state().eta[2] == 20);
  }

  TEST_CASE_TEMPLATE("in a steady turn yaw rate and sway solve the two equations of sway and yaw", Plant,
                     SubmarinePlant, RigidSubmarine) {
    SubmarineParameters parameters;
    parameters.hull.z_g = 0;  // no banking
    parameters.hull.buoyancy = parameters.hull.mass * parameters.sea.gravity;
    parameters.quadratic_damping.Y_vv = parameters.quadratic_damping.Y_rr = 0;
    parameters.quadratic_damping.N_vv = parameters.quadratic_damping.N_rr = 0;
    Plant plant(make_body(parameters), {}, deep(1));
    const double rudder = 8 * angle;
    SubmarineInput input{.propeller = 200, .fins = {rudder, 0, 0, rudder}};
    for (int i = 0; i < 12000; ++i) plant.step(input);
    const fossen::Vector6 nu = plant.state().nu;
    const double u = nu[0], lift = 2 * 4.8 * rudder * u * u;
    // sway:  (Y_v + Y_uv u) v + (Y_r + Y_ur u - (m - X_u_dot) u) r = -lift
    // yaw:   (N_v + N_uv u + (X_u_dot - Y_v_dot) u) v + (N_r + N_ur u) r = -x lift; Munk's moment: (34 - 19) u v
    Eigen::Matrix2d A;
    A << -23 - 20.6 * u, 11.5 + 3.84 * u - 19 * u, 3.1 + 6 * u - 15 * u, -9.7 - 1.53 * u;
    const Eigen::Vector2d solved = A.inverse() * Eigen::Vector2d(-lift, 0.4 * lift);
    CHECK(nu[1] == doctest::Approx(solved[0]).scale(0).epsilon(1e-6));
    CHECK(nu[5] == doctest::Approx(solved[1]).scale(0).epsilon(1e-6));
    CHECK(nu[5] < -0.05);
  }

  TEST_CASE_TEMPLATE("driven onto the sea floor it comes to rest on it", Plant, SubmarinePlant, RigidSubmarine) {
    SubmarineParameters parameters;
    parameters.hull.mass = 20;
    parameters.sea.floor = 6;
    PlantState start = deep(1.5);
    start.eta[2] = 5;
    start.eta[4] = -30 * angle;
    Plant plant(make_body(parameters), {}, start);
    double deepest = 0;
    for (int i = 0; i < 3000; ++i) {
      plant.step({});
      deepest = std::max(deepest, plant.state().eta[2]);
    }
    const PlantState end = plant.state();
    CHECK(deepest < 6);
    // two springs of 5 kN/m carry what buoyancy does not
    CHECK(end.eta[2] == doctest::Approx(6 - 0.075 + (20 * 9.81 - 177.58) / 10000).scale(0).epsilon(1e-5));
    for (const double speed : end.nu) CHECK(std::abs(speed) < 1e-6);
  }

  TEST_CASE_TEMPLATE("in straight deep run the terminal speed is that at which drag equals thrust", Plant,
                     SubmarinePlant, RigidSubmarine) {
    SubmarineParameters parameters;
    parameters.hull.z_g = 0;
    parameters.hull.buoyancy = parameters.hull.mass * parameters.sea.gravity;
    const auto speed = [&](double propeller) {
      Plant plant(make_body(parameters), {}, deep(1));
      SubmarineInput input;
      input.propeller = propeller;
      for (int i = 0; i < 12000; ++i) plant.step(input);
      return plant.state().nu[0];
    };
    // 2.4 u + 2.4 u^2 = 2.1e-4 200^2
    const double expected = (-2.4 + std::sqrt(2.4 * 2.4 + 4 * 2.4 * 8.4)) / (2 * 2.4);
    CHECK(speed(200) == doctest::Approx(expected).scale(0).epsilon(1e-6));
    // the Jarol thesis, section 2.2.1: 2 m/s at most
    CHECK(speed(parameters.thruster.full_speed) == doctest::Approx(2).scale(0).epsilon(1e-3));
  }

  TEST_CASE_TEMPLATE("at rest it floats where its buoyancy carries its weight", Plant, SubmarinePlant, RigidSubmarine) {
    const SubmarineBody body = make_body({});
    PlantState start;
    start.eta[2] = calc_floating_depth(body.hull);
    Plant plant(body, {}, start);
    for (int i = 0; i < 1000; ++i) plant.step({});
    CHECK(std::abs(plant.state().eta[2] - start.eta[2]) < 1e-9);
    CHECK(std::abs(plant.state().nu[2]) < 1e-9);
  }

  TEST_CASE_TEMPLATE("deep down the surplus of buoyancy carries it up", Plant, SubmarinePlant, RigidSubmarine) {
    Plant plant(make_body({}), {}, deep(0));
    for (int i = 0; i < 500; ++i) plant.step({});
    CHECK(plant.state().eta[2] < 20);
    CHECK(plant.state().nu[2] < 0);
  }
}
