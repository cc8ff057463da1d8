// The plant, in Simbody and as one rigid body, against a second model of the same helicopter, and against what physics
// demands of both.
#include "vehicles/helicopter/plant.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "distributers/interfaces/no_state.h"
#include "tests/vehicles/helicopter_oracle.h"
#include "vehicles/helicopter/coefficients.h"
#include "vehicles/helicopter/rigid_plant.h"

namespace {
using namespace jarol::vehicles;
using Eigen::Vector3d;

Vector3d vector(const fossen::Vector3& v) { return {v[0], v[1], v[2]}; }

double hover_setting(const HelicopterParameters& p) {
  return std::pow(p.frame.mass * p.air.gravity / 4 / p.rotors.full_thrust, 1 / p.rotors.thrust_exponent);
}

HelicopterMotion high(double height) {
  HelicopterMotion motion;
  motion.p_n = {0, 0, -height};
  return motion;
}

// Settings of a smooth minute: small turning impulses to all sides, each taken back, and a little more and less thrust.
std::array<double, 4> minute(double hover, double time) {
  const auto push = [time](double at, double width) {
    return time >= at && time < at + width ? 1.0 : time >= at + width && time < at + 2 * width ? -1.0 : 0.0;
  };
  const double roll = 0.02 * (push(2, 0.3) - push(20, 0.3)), pitch = 0.02 * (push(10, 0.3) - push(30, 0.2));
  const double yaw = 0.01 * (push(15, 1) - push(40, 1)), climb = 0.01 * std::sin(0.4 * time);
  return {hover + climb - yaw + pitch, hover + climb + yaw - roll, hover + climb - yaw - pitch,
          hover + climb + yaw + roll};
}
}  // namespace

TEST_SUITE("vehicles/helicopter_plant") {
  TEST_CASE_TEMPLATE("after a minute of turns in wind it stands within a millionth of the way where the oracle stands",
                     Plant, HelicopterPlant, RigidHelicopter) {
    const HelicopterParameters parameters;
    const double hover = hover_setting(parameters);
    Plant plant(make_body(parameters), high(300), {hover, hover, hover, hover});
    jarol::test::HelicopterOracle oracle(parameters, 300, {hover, hover, hover, hover});
    double way = 0, worst = 0, turned = 0;
    Vector3d last = oracle.position();
    for (int i = 0; i < 12000; ++i) {
      const auto settings = minute(hover, 0.005 * i);
      plant.step({settings, {0.5, -0.3, 0.1}});
      oracle.advance(0.005, settings, {0.5, -0.3, 0.1});
      way += (oracle.position() - last).norm();
      last = oracle.position();
      worst = std::max(worst, (vector(plant.motion().p_n) - last).norm());
      turned = std::max(turned, (vector(plant.motion().omega_b) - oracle.rates()).norm());
    }
    MESSAGE("way " << way << " m, largest deviation " << worst << " m, of rates " << turned << " rad/s");
    CHECK(way > 20);
    CHECK(worst < 1e-6 * way);
  }

  TEST_CASE_TEMPLATE("at the setting of hover the thrust equals the weight", Plant, HelicopterPlant, RigidHelicopter) {
    const HelicopterParameters parameters;
    const double hover = hover_setting(parameters);
    CHECK(hover * 16000 == doctest::Approx(8000).scale(0).epsilon(1e-3));
    Plant plant(make_body(parameters), high(1000), {hover, hover, hover, hover});
    for (int i = 0; i < 400; ++i) plant.step({{hover, hover, hover, hover}, {}});
    // what is left of the ground effect at 1000 m
    CHECK(std::abs(plant.motion().p_n[2] + 1000) < 1e-6);
    CHECK(plant.specific_force()[2] == doctest::Approx(-9.81).scale(0).epsilon(1e-8));
  }

  TEST_CASE_TEMPLATE("in free fall without air an accelerometer reads zero, and it falls by g t^2 / 2", Plant,
                     HelicopterPlant, RigidHelicopter) {
    HelicopterParameters parameters;
    parameters.frame.drag_area = 0;
    Plant plant(make_body(parameters), high(100));
    for (int i = 0; i < 400; ++i) plant.step({});
    for (const double a : plant.specific_force()) CHECK(a == 0);
    CHECK(plant.motion().p_n[2] == doctest::Approx(-100 + 9.81 * 2).scale(0).epsilon(1e-10));
  }

  TEST_CASE_TEMPLATE("falling in air it reaches the speed at which drag equals weight", Plant, HelicopterPlant,
                     RigidHelicopter) {
    const HelicopterParameters parameters;
    Plant plant(make_body(parameters), high(5000));
    for (int i = 0; i < 12000; ++i) plant.step({});
    CHECK(plant.motion().v_b[2] == doctest::Approx(std::sqrt(2 * 1.5 * 9.81 / (1.225 * 0.03))).scale(0).epsilon(1e-6));
  }

  TEST_CASE_TEMPLATE("standing in wind it creeps less than 1 mm in 10 s, and reads its weight", Plant, HelicopterPlant,
                     RigidHelicopter) {
    Plant plant(make_body({}), make_start({}));
    const auto command = HelicopterCommand{{0.2, 0.2, 0.2, 0.2}, {8, 3, 0}};
    for (int i = 0; i < 200; ++i) plant.step(command);
    const Vector3d before = vector(plant.motion().p_n);
    for (int i = 0; i < 2000; ++i) plant.step(command);
    const Vector3d after = vector(plant.motion().p_n);
    MESSAGE("creep " << (after - before).norm() << " m");
    CHECK((after - before).norm() < 1e-6);
    CHECK(-plant.specific_force()[2] == doctest::Approx(9.81).scale(0).epsilon(1e-3));
  }

  TEST_CASE_TEMPLATE("dropped from half a metre it comes to rest on its feet", Plant, HelicopterPlant,
                     RigidHelicopter) {
    HelicopterMotion start = make_start({});
    start.p_n[2] -= 0.5;
    Plant plant(make_body({}), start);
    double lowest = -1;
    for (int i = 0; i < 600; ++i) {
      plant.step({});
      lowest = std::max(lowest, plant.motion().p_n[2]);
    }
    CHECK(lowest < -0.17);  // the feet gave way by less than 3 cm
    CHECK(std::abs(plant.motion().p_n[2] - make_start({}).p_n[2]) < 1e-4);
    CHECK(std::abs(plant.motion().v_b[2]) < 1e-3);
  }

  TEST_CASE_TEMPLATE("a strong wind drags it along, for friction has its limit", Plant, HelicopterPlant,
                     RigidHelicopter) {
    Plant plant(make_body({}), make_start({}));
    for (int i = 0; i < 400; ++i) plant.step({{}, {30, 0, 0}});
    CHECK(plant.motion().p_n[0] > 0.1);
  }

  TEST_CASE_TEMPLATE("near the ground the same setting lifts more, as Cheeseman and Bennett say", Plant,
                     HelicopterPlant, RigidHelicopter) {
    const HelicopterParameters parameters;
    const double hover = hover_setting(parameters);
    Plant plant(make_body(parameters), high(0.45), {hover, hover, hover, hover});
    const double gain = 1 / (1 - std::pow(0.25 / (4 * 0.5), 2));  // hubs at 0.5 m
    CHECK(-plant.specific_force()[2] == doctest::Approx(9.81 * gain).scale(0).epsilon(1e-9));
  }

  TEST_CASE_TEMPLATE("while it rolls, rotors that all turn one way pitch it: momentum is kept", Plant, HelicopterPlant,
                     RigidHelicopter) {
    HelicopterBody body = make_body({});
    for (auto& rotor : body.rotors) rotor.spin = 1;
    body.torque_per_thrust = body.rotor_drag = body.rotor_inflow = 0;
    HelicopterMotion start = high(500);
    start.omega_b = {1, 0, 0};
    Plant plant(body, start, {0.5, 0.5, 0.5, 0.5});
    const double spin = 4 * body.rotor_inertia * body.full_speed * std::pow(0.5, body.thrust_law.exponent() / 2);
    const auto momentum = [&] {
      const HelicopterMotion m = plant.motion();
      const fossen::Vector3 L = to_ned(m.R_nb, {body.inertia[0] * m.omega_b[0], body.inertia[1] * m.omega_b[1],
                                                body.inertia[2] * m.omega_b[2] + spin});
      return vector(L);
    };
    const Vector3d before = momentum();
    plant.step({{0.5, 0.5, 0.5, 0.5}, {}});
    CHECK(plant.motion().omega_b[1] > 0.01);
    for (int i = 0; i < 200; ++i) plant.step({{0.5, 0.5, 0.5, 0.5}, {}});
    CHECK((momentum() - before).norm() < 1e-4 * before.norm());
  }

  TEST_CASE_TEMPLATE("tumbling without air it keeps its energy and its angular momentum", Plant, HelicopterPlant,
                     RigidHelicopter) {
    HelicopterParameters parameters;
    parameters.frame.drag_area = 0;
    parameters.frame.I_y = 0.02;
    HelicopterMotion start = high(500);
    start.v_b = {3, -2, -5};
    start.omega_b = {4, 0.1, 2};
    const HelicopterBody body = make_body(parameters);
    Plant plant(body, start);
    const auto momentum = [&] {
      const HelicopterMotion m = plant.motion();
      return vector(to_ned(
          m.R_nb, {body.inertia[0] * m.omega_b[0], body.inertia[1] * m.omega_b[1], body.inertia[2] * m.omega_b[2]}));
    };
    const auto energy = [&] {
      const HelicopterMotion m = plant.motion();
      double twice = body.mass * vector(m.v_b).squaredNorm();
      for (std::size_t i = 0; i < 3; ++i) twice += body.inertia[i] * m.omega_b[i] * m.omega_b[i];
      return 0.5 * twice - body.mass * body.gravity * m.p_n[2];
    };
    const double energy_before = energy();
    const Vector3d momentum_before = momentum();
    for (int i = 0; i < 1000; ++i) plant.step({});
    CHECK(energy() == doctest::Approx(energy_before).scale(0).epsilon(1e-6));
    CHECK((momentum() - momentum_before).norm() < 1e-5 * momentum_before.norm());
  }

  TEST_CASE_TEMPLATE("a setting that is not a number is reported, then and ever after", Plant, HelicopterPlant,
                     RigidHelicopter) {
    Plant plant(make_body({}), high(10));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 2; ++i) CHECK_THROWS_AS(plant.step({{nan, 0, 0, 0}, {}}), NoState);
    CHECK_THROWS_AS(plant.step({}), NoState);
  }

  TEST_CASE_TEMPLATE("the same inputs give the same bits, whoever looks", Plant, HelicopterPlant, RigidHelicopter) {
    Plant one(make_body({}), make_start({})), two(make_body({}), make_start({}));
    for (int i = 0; i < 400; ++i) {
      const auto settings = minute(i < 200 ? 0.55 : 0.4, 0.1 * i);
      one.step({settings, {}});
      two.step({settings, {}});
      if (i % 3 == 0) static_cast<void>(two.specific_force());
    }
    CHECK(one.motion().p_n == two.motion().p_n);
    CHECK(one.motion().omega_b == two.motion().omega_b);
    CHECK(one.motion().R_nb == two.motion().R_nb);
  }
}
