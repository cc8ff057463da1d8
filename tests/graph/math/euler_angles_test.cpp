#include "graph/math/euler_angles.h"

#include <doctest/doctest.h>

#include "graph/math/rotations.h"

namespace {
using namespace jarol;
using Eigen::Vector3d;

constexpr double rounding = 1e-15;  // of numbers about 1, a few operations on

auto about(double value) { return doctest::Approx(value).scale(1).epsilon(rounding); }

TEST_SUITE("graph/math/euler_angles") {
  TEST_CASE("a rotation's angles are those that it was made of") {
    for (const double roll : {-2.5, 0.0, 0.7}) {
      for (const double pitch : {-1.2, 0.0, 0.9}) {
        for (const double yaw : {-3.0, 0.0, 1.6}) {
          const EulerAngles angles = euler_angles_of(rotation_of(roll, pitch, yaw));
          CHECK(angles.roll == about(roll));
          CHECK(angles.pitch == about(pitch));
          CHECK(angles.yaw == about(yaw));
        }
      }
    }
  }

  TEST_CASE("where rounding makes an element of it greater than 1 its pitch is a right angle") {
    const std::array<std::array<double, 3>, 3> rows = {{{0, 0, 0}, {0, 1, 0}, {-1 - 1e-15, 0, 0}}};
    CHECK(euler_angles_of(rows).pitch == pi / 2);
  }

  TEST_CASE("down, sinking and what a length is vertically are the third row of the rotation") {
    for (const double roll : {-2.5, 0.0, 0.7}) {
      for (const double pitch : {-1.2, 0.0, 0.9}) {
        const Vector3d down_b = rotation_of(roll, pitch, 1.1).row(2).transpose();
        const std::array<double, 3> down = down_in_body(roll, pitch);
        for (std::size_t i = 0; i < 3; ++i) CHECK(down[i] == about(down_b[static_cast<Eigen::Index>(i)]));
        CHECK(vertical_part(5, roll, pitch) / 5 == about(down_b.z()));
        CHECK(sinking(roll, pitch, 0.4, -0.3, 0.2) == about(down_b.dot(Vector3d(0.4, -0.3, 0.2))));
        CHECK(sinking_across(roll, pitch, -0.3, 0.2) == about(down_b.dot(Vector3d(0, -0.3, 0.2))));
      }
    }
  }
}
}  // namespace
