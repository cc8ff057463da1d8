// Places from ranges in a room, against the formula of the JAviator's flight controller.
#include "tasks/javiator/room.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace {
using namespace jarol::tasks;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// its constants, from a laser to the centre of gravity
const Vector3d controllers_x(0.070, -0.075, -0.080);

Matrix3d turned(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Vector3d::UnitX()))
      .toRotationMatrix();
}
}  // namespace

TEST_SUITE("tasks/javiator_room") {
  TEST_CASE("turned by less than 45 degrees a place is what the flight controller computes, less the wall") {
    for (const double yaw : {0.0, 0.404, -0.7})
      for (const double roll : {-0.2, 0.1})
        for (const double pitch : {-0.1, 0.3}) {
          const Matrix3d R = turned(roll, pitch, yaw);
          const double range = 7.5;
          // R (lever - range along x): "the negative of the distance"
          const double controllers = (R * (controllers_x - Vector3d(range, 0, 0))).x();
          const WallFix fix = find_place({}, R * -controllers_x, R.col(0), range, {8 + controllers, 0});
          CHECK(fix.seen);
          CHECK(fix.axis == 0);
          CHECK(fix.place == doctest::Approx(8 + controllers));
        }
  }

  TEST_CASE("a laser that is turned to another wall measures along that wall's axis") {
    const auto fix = [](double yaw, double range, const Eigen::Vector2d& expected) {
      return find_place({.north = 8, .east = 6, .south = 12, .west = 10}, {0, 0, 0}, turned(0, 0, yaw).col(0), range,
                        expected);
    };
    constexpr double quarter = 1.5707963267948966;
    CHECK(fix(quarter, 5, {0, 0}).axis == 1);
    CHECK(fix(quarter, 5, {0, 0}).place == doctest::Approx(1));
    CHECK(fix(2 * quarter, 5, {0, 0}).axis == 0);
    CHECK(fix(2 * quarter, 5, {0, 0}).place == doctest::Approx(-7));
    CHECK(fix(-quarter, 9, {0, 0}).place == doctest::Approx(-1));
    // towards a corner the place shows which wall it was
    const double yaw = std::atan2(6, 8);
    CHECK(fix(yaw, 9.9, {0.1, 0}).axis == 0);
    CHECK(fix(yaw, 9.9, {0, 0.1}).axis == 1);
    CHECK(fix(yaw, 9.9, {0, 0.1}).at_corner);
    // whatever the range is: one that fits the other wall better may be wrong, and so may the place
    CHECK(fix(yaw + 0.2, 8, {0, 0}).axis == 1);
    CHECK(fix(yaw - 0.2, 8, {0, 0}).axis == 0);
    CHECK_FALSE(fix(yaw + 0.2, 8, {0, 0}).at_corner);
    CHECK_FALSE(fix(0, 7, {0, 0}).at_corner);
    // from beyond a wall nothing is met there
    CHECK(fix(yaw, 9.9, {8.5, 0}).axis == 1);
    CHECK_FALSE(fix(yaw, 9.9, {8.5, 0}).at_corner);
  }

  TEST_CASE("a wall that is near is met before the one ahead, however little it is turned to it") {
    // 60 cm from the wall in the south; a laser looks east and ever more to the south
    const auto fix = [](double yaw, double range) {
      return find_place({}, {0, 0, 0}, turned(0, 0, yaw).col(1), range, {-11.4, 0});
    };
    CHECK(fix(0, 8).axis == 1);
    CHECK_FALSE(fix(0, 8).at_corner);
    CHECK_FALSE(fix(0.05, 8).at_corner);  // 12 m away, or 10 if it stands 10 cm nearer
    CHECK(fix(0.06, 8).at_corner);        // 10 m away, or 8.3
    CHECK(fix(0.075, 8).at_corner);
    CHECK(fix(0.09, 6.7).at_corner);  // that wall, which it grazes
    CHECK_FALSE(fix(0.12, 5).at_corner);
    // 10 cm from it it is far before the other one, but shows no place
    CHECK(find_place({}, {0, 0, 0}, turned(0, 0, 0.08).col(1), 1.2, {-11.9, 0}).at_corner);
    // and so if it is expected a little beyond it
    CHECK(find_place({}, {0, 0, 0}, turned(0, 0, 0.12).col(1), 0.5, {-12.01, 0}).axis == 0);
    CHECK(fix(0.12, 0.6 / std::sin(0.12)).axis == 0);
    CHECK(fix(0.12, 0.6 / std::sin(0.12)).place == doctest::Approx(-11.4));
  }

  TEST_CASE("a range of zero is that of nothing seen") {
    CHECK_FALSE(find_place({}, {0, 0, 0}, {1, 0, 0}, 0, {0, 0}).seen);
    CHECK_FALSE(find_place({}, {0, 0, 0}, {0, 0, 1}, 1, {0, 0}).seen);  // straight down
  }
}
