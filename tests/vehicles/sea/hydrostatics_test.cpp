// Weight and buoyancy against sums over small cells of the hull.
#include "vehicles/sea/hydrostatics.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace {
using namespace jarol::vehicles;
using Eigen::Vector3d;

struct Cells {
  double part = 0;
  Vector3d centre_b = Vector3d::Zero();
};

// The part of an ellipsoid under water, of cells in a box around it.
Cells count_cells(const FloatingHull& hull, double z, const Vector3d& down_b) {
  constexpr int count = 120;
  long all = 0, wet = 0;
  Cells cells;
  const auto middle = [](int i) { return (2.0 * i + 1) / count - 1; };
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      for (int k = 0; k < count; ++k) {
        const Vector3d in_sphere(middle(i), middle(j), middle(k));
        if (in_sphere.squaredNorm() > 1) continue;
        ++all;
        const Vector3d p_b(hull.semi_axes[0] * in_sphere.x(), hull.semi_axes[1] * in_sphere.y(),
                           hull.semi_axes[2] * in_sphere.z());
        if (z + down_b.dot(p_b) < 0) continue;
        ++wet;
        cells.centre_b += p_b;
      }
    }
  }
  cells.part = static_cast<double>(wet) / static_cast<double>(all);
  if (wet > 0) cells.centre_b /= static_cast<double>(wet);
  return cells;
}

Vector3d vector(const fossen::Vector3& v) { return {v[0], v[1], v[2]}; }
}  // namespace

TEST_SUITE("vehicles/hydrostatics") {
  TEST_CASE("part and centre under water, and the force and moment of both, are those of the hull's cells") {
    FloatingHull hull;
    hull.W = 176;
    hull.B = 178;
    hull.r_bg = {0.02, -0.01, 0.03};
    hull.semi_axes = {0.55, 0.075, 0.1};
    for (const double z : {-0.06, -0.02, 0.0, 0.03, 0.2}) {
      for (const double pitch : {-0.6, 0.0, 0.3}) {
        for (const double roll : {0.0, 0.8}) {
          CAPTURE(z);
          CAPTURE(pitch);
          CAPTURE(roll);
          const Vector3d down_b =
              (Eigen::AngleAxisd(pitch, Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Vector3d::UnitX()))
                  .toRotationMatrix()
                  .transpose() *
              Vector3d::UnitZ();
          const Immersion at{z, {down_b.x(), down_b.y(), down_b.z()}};
          const Immersed immersed = calc_immersed(hull, at);
          const Cells cells = count_cells(hull, z, down_b);
          CHECK(std::abs(immersed.part - cells.part) < 3e-3);
          CHECK((vector(immersed.centre_b) - cells.centre_b).norm() < 3e-3);
          // weight at its centre, buoyancy at its own
          const fossen::Vector6 tau = restoring_force(hull, immersed, at);
          const Vector3d weight = hull.W * down_b, buoyancy = -hull.B * cells.part * down_b;
          CHECK((Vector3d(tau[0], tau[1], tau[2]) - weight - buoyancy).norm() < 0.6);
          CHECK((Vector3d(tau[3], tau[4], tau[5]) - vector(hull.r_bg).cross(weight) - cells.centre_b.cross(buoyancy))
                    .norm() < 0.6);
        }
      }
    }
  }

  TEST_CASE("pitched at the surface it turns back, and deep down its low weight turns it back") {
    FloatingHull hull;
    hull.W = hull.B = 178;
    hull.semi_axes = {0.55, 0.075, 0.075};
    const auto pitching = [&](double z) {
      const Immersion at{z, {-std::sin(0.1), 0, std::cos(0.1)}};  // nose up
      return restoring_force(hull, calc_immersed(hull, at), at)[4];
    };
    CHECK(pitching(0) < -1);
    CHECK(pitching(5) == 0);
    hull.r_bg = {0, 0, 0.01};
    CHECK(pitching(5) == doctest::Approx(-178 * 0.01 * std::sin(0.1)));
  }
}
