// The feet against their law, and a drop onto them against the same fall in one dimension.
#include "vehicles/helicopter/feet.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "vehicles/helicopter/coefficients.h"
#include "vehicles/helicopter/plant.h"

namespace {
using namespace jarol::vehicles;

Feet make_feet() {
  Feet feet;
  feet.stiffness = 1000;
  feet.dissipation = 10;
  feet.friction = 0.5;
  feet.grip_stiffness = 2000;
  feet.grip_damping = 30;
  return feet;
}
}  // namespace

TEST_SUITE("vehicles/feet") {
  TEST_CASE("the ground pushes with its stiffness, more while it is pressed, and never pulls") {
    const Feet feet = make_feet();
    const auto up = [&](double depth, double sinking) {
      return -calc_foot_force(feet, {{0, 0, depth}, {0, 0, sinking}}, {})[2];
    };
    CHECK(up(-0.001, 0) == 0);
    CHECK(up(0, 1) == 0);
    CHECK(up(0.01, 0) == doctest::Approx(10));
    CHECK(up(0.01, 0.05) == doctest::Approx(15));
    CHECK(up(0.01, -0.099) == doctest::Approx(0.1));
    CHECK(up(0.01, -0.101) == 0);
    CHECK(up(0.01, -5) == 0);
  }

  TEST_CASE("along the ground a foot is held by a spring and a damper, up to its friction") {
    const Feet feet = make_feet();
    const auto held = calc_foot_force(feet, {{0.001, -0.0005, 0.01}, {0.01, 0, 0}}, {});
    CHECK(held[0] == doctest::Approx(-2000 * 0.001 - 30 * 0.01));
    CHECK(held[1] == doctest::Approx(2000 * 0.0005));
    const auto slides = calc_foot_force(feet, {{0.03, -0.04, 0.01}, {}}, {});
    CHECK(slides[0] == doctest::Approx(-0.5 * 10 * 0.6));
    CHECK(slides[1] == doctest::Approx(0.5 * 10 * 0.8));
    CHECK(slides[2] == doctest::Approx(-10));
  }

  TEST_CASE("the place where a foot grips is dragged along as far as friction does not reach, and left in the air") {
    const Feet feet = make_feet();
    const FootAnchor near = drag_along(feet, {{0.0024, 0, 0.01}, {}}, {});
    CHECK(near.x == 0);
    const FootAnchor far = drag_along(feet, {{0.03, 0.04, 0.01}, {}}, {});
    CHECK(far.x == doctest::Approx(0.03 - 0.0025 * 0.6));
    CHECK(far.y == doctest::Approx(0.04 - 0.0025 * 0.8));
    const FootAnchor lifted = drag_along(feet, {{0.03, 0.04, -0.01}, {}}, {});
    CHECK(lifted.x == 0.03);
    CHECK(lifted.y == 0.04);
  }

  TEST_CASE("the helicopter's feet grip with half of the damping that is critical for it") {
    const HelicopterParameters parameters;
    const Feet feet = make_body(parameters).feet;
    CHECK(feet.grip_stiffness == 2500);
    // four springs and dampers: zeta = c / (2 sqrt(k m))
    CHECK(4 * feet.grip_damping / (2 * std::sqrt(4 * feet.grip_stiffness * 1.5)) == doctest::Approx(0.5));
  }

  TEST_CASE("dropped from 5 cm it moves as the same fall does in steps a thousand times smaller") {
    HelicopterParameters parameters;
    parameters.frame.drag_area = 0;
    HelicopterMotion start = make_start(parameters);
    start.p_n[2] -= 0.05;
    const HelicopterBody body = make_body(parameters);
    HelicopterPlant plant(body, start);
    double z = start.p_n[2], sinking = 0, worst = 0;
    const double dt = 5e-6, k = 4 * body.feet.stiffness, c = body.feet.dissipation, below = parameters.feet.height;
    for (int i = 0; i < 100; ++i) {
      plant.step({});
      for (int j = 0; j < 1000; ++j) {
        const double depth = std::max(z + below, 0.0);
        sinking += dt * (9.81 - std::max(k * depth * (1 + c * sinking), 0.0) / 1.5);
        z += dt * sinking;
      }
      worst = std::max(worst, std::abs(plant.motion().p_n[2] - z));
    }
    CAPTURE(worst);
    CHECK(worst < 2e-5);
  }

  TEST_CASE("no part touches the ground where none may, however it leans and spins") {
    const HelicopterBody body = make_body({});
    std::mt19937_64 draw(7);
    std::uniform_real_distribution<double> any(-1, 1);
    int apart = 0, nearest_apart = 0;
    for (int i = 0; i < 20'000; ++i) {
      HelicopterMotion motion;
      const Eigen::Matrix3d R_nb =
          Eigen::Quaterniond(any(draw), any(draw), any(draw), any(draw)).normalized().toRotationMatrix();
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
          motion.R_nb[row][column] = R_nb(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
      const double margin = 0.5 * (1 + any(draw));
      motion.p_n[2] = -0.75 + 0.75 * any(draw);
      double lowest = -1e9;
      for (const fossen::Vector3& r_b : body.feet.r_b) lowest = std::max(lowest, foot_depth(motion, r_b));
      if (may_touch(body, motion, margin)) continue;
      ++apart;
      CHECK(lowest < -margin);
      if (lowest > -margin - 0.01) ++nearest_apart;
    }
    CHECK(apart > 1000);
    CHECK(nearest_apart > 0);  // and it does not give room away
  }
}
