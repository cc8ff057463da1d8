#include "graph/math/rotations.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol;
using Eigen::Vector3d;

constexpr double degree = 3.14159265358979323846 / 180;

bool near(const Vector3d& a, const Vector3d& b, double max = 1e-12) { return (a - b).norm() < max; }

TEST_SUITE("graph/math/rotations") {
  // as a pilot sees them: the nose turns right, goes up, the right wing goes down
  TEST_CASE("yaw turns the nose from north to east, pitch raises it, roll lowers the right side") {
    const Vector3d nose(1, 0, 0), right(0, 1, 0), below(0, 0, 1);
    CHECK(near(rotation_of(0, 0, 90 * degree) * nose, {0, 1, 0}));
    CHECK(near(rotation_of(0, 90 * degree, 0) * nose, {0, 0, -1}));
    CHECK(near(rotation_of(90 * degree, 0, 0) * right, {0, 0, 1}));
    // first yaw, then pitch about the turned axis, then roll about the nose
    const Vector3d east_and_up = rotation_of(0, 30 * degree, 90 * degree) * nose;
    CHECK(near(east_and_up, {0, std::cos(30 * degree), -0.5}));
    CHECK(near(rotation_of(50 * degree, 30 * degree, 90 * degree) * nose, east_and_up));
    CHECK(near(rotation_of(90 * degree, 30 * degree, 0) * below, {0, -1, 0}));
    CHECK(near(quaternion_of(0.3, -0.4, 2.5) * right, rotation_of(0.3, -0.4, 2.5) * right));
  }

  TEST_CASE("the rates of the angles are those by which the turned matrix differs") {
    for (const double roll : {-2.0, 0.0, 0.7}) {
      for (const double pitch : {-1.2, 0.0, 0.9}) {
        CAPTURE(roll);
        CAPTURE(pitch);
        const double yaw = 2.0, dt = 1e-6;
        const Vector3d omega(0.3, -0.5, 0.8);
        const Vector3d rates = euler_rates(roll, pitch, omega);
        const Eigen::Matrix3d turned =
            rotation_of(roll, pitch, yaw) * Eigen::AngleAxisd(omega.norm() * dt, omega.normalized());
        const Eigen::Matrix3d by_angles =
            rotation_of(roll + rates.x() * dt, pitch + rates.y() * dt, yaw + rates.z() * dt);
        CHECK((turned - by_angles).norm() < 1e-10);
      }
    }
    CHECK(near(euler_rates(0, 0, {1, 2, 3}), {1, 2, 3}));
  }

  TEST_CASE("the greatest pitch of rates is where its cosine is a tenth") {
    CHECK(std::cos(max_pitch_of_rates) == doctest::Approx(0.1).scale(0).epsilon(1e-12));
  }
}
}  // namespace
