// What becomes of a vehicle that no mission wants, at the edge of each limit.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "vehicles/helicopter/helicopter.h"
#include "vehicles/submarine/submarine.h"

namespace {
using namespace jarol;
using namespace jarol::vehicles;
using std::chrono::nanoseconds;

// Falls from so high, level and with its motors off.
std::optional<Mishap> fallen(double height) {
  HelicopterParameters p;
  p.frame.drag_area = 0;
  p.start.altitude = height;
  Helicopter helicopter(p);
  for (int i = 0; i < 200; ++i) helicopter.step();
  return helicopter.mishap();
}

// Hangs in the air, tilted about its nose.
HelicopterMotion tilted(double angle, double z = -5) {
  HelicopterMotion motion;
  motion.p_n = {0, 0, z};
  motion.R_nb = {{{1, 0, 0}, {0, std::cos(angle), -std::sin(angle)}, {0, std::sin(angle), std::cos(angle)}}};
  return motion;
}

std::string mishap_of(const HelicopterMotion& motion) {
  HelicopterJudge judge({}, tilted(0));
  judge.look(nanoseconds(1), motion, {});
  return judge.mishap() ? judge.mishap()->text : "";
}

std::string mishap_of(const VehicleState& state, const SubmarineParameters& parameters = {}) {
  SubmarineJudge judge(parameters, {});
  judge.look(nanoseconds(1), state);
  return judge.mishap() ? judge.mishap()->text : "";
}

// Its rotors follow that signal on the ground for so many steps of 5 ms.
std::optional<Mishap> driven(double signal, int steps) {
  HelicopterMotion on_ground = tilted(0, -0.2);
  HelicopterJudge judge({}, on_ground);
  const double s = signal / 16000.0;
  for (int i = 1; i <= steps; ++i) judge.look(std::chrono::milliseconds(5) * i, on_ground, {s, s, s, s});
  return judge.mishap();
}
}  // namespace

TEST_SUITE("vehicles/judge") {
  TEST_CASE("a fall at 2 m/s and more is a crash: v^2 = 2 g h") {
    CHECK(!fallen(0.198).has_value());  // 1.97 m/s
    const auto crash = fallen(0.23);    // 2.12 m/s
    REQUIRE(crash.has_value());
    CHECK(crash->text == "crashed: a foot met the ground at 2.1 m/s, above 2 m/s");
    CHECK(crash->instant >= std::chrono::milliseconds(215));
    CHECK(crash->instant <= std::chrono::milliseconds(225));
    CHECK(fallen(1.0)->text == "crashed: a foot met the ground at 4.4 m/s, above 2 m/s");
  }

  TEST_CASE("a rotor at the ground is a crash, a tilt beyond a right angle a capsize") {
    CHECK(mishap_of(tilted(89.9 * degree)) == "");
    CHECK(mishap_of(tilted(90.1 * degree)) == "capsized: tilted by 90 deg, beyond 90 deg");
    CHECK(mishap_of(tilted(-170 * degree)) == "capsized: tilted by 170 deg, beyond 90 deg");
    // a rotor's tip is 0.30 m + 0.25 m out and 0.05 m up
    const double z = 0.55 * std::sin(0.8) - 0.05 * std::cos(0.8);
    CHECK(mishap_of(tilted(0.8, -z - 0.001)) == "");
    CHECK(mishap_of(tilted(0.8, -z + 0.001)) == "crashed: a rotor met the ground");
  }

  TEST_CASE("the top at the ground is a crash too, and every part's speed at the ground is kept") {
    HelicopterMotion head_first = tilted(180 * degree, -0.121);
    head_first.v_b = {0, 0, -3};  // its axis points up
    HelicopterJudge judge({}, head_first);
    head_first.p_n[2] = -0.119;
    judge.look(std::chrono::milliseconds(5), head_first, {});
    CHECK(judge.mishap()->text == "crashed: its top met the ground");
    CHECK(judge.truth().impact == doctest::Approx(3));
    CHECK(judge.truth().touch_down == doctest::Approx(3));
  }

  TEST_CASE("how fast its middle came down is kept apart from how fast a foot did as it turned") {
    // its right foot, 0.2 m out and 0.2 m down, comes down by 2 rad/s and 0.1 m/s; its middle by 0.1 m/s
    HelicopterMotion turning = tilted(0, -0.2001);
    turning.v_b = {0, 0, 0.1};
    turning.omega_b = {2, 0, 0};
    HelicopterJudge judge({}, turning);
    CHECK(judge.truth().touch_down == 0);
    turning.p_n[2] = -0.1999;
    judge.look(std::chrono::milliseconds(5), turning, {});
    CHECK(judge.truth().impact == doctest::Approx(0.5).epsilon(1e-6).scale(0));
    CHECK(judge.truth().touch_down == doctest::Approx(0.1).epsilon(1e-6).scale(0));
    // on its feet, however fast it sinks, it touches down no more
    turning.p_n[2] = -0.1998;
    turning.v_b = {0, 0, 0.7};
    judge.look(std::chrono::milliseconds(10), turning, {});
    CHECK(judge.truth().touch_down == doctest::Approx(0.1).epsilon(1e-6).scale(0));
    // what the ground has slowed down within a step counts as it was before
    HelicopterJudge slowed({}, tilted(0, -0.2001));
    turning.p_n[2] = -0.1999;
    turning.v_b = {0, 0, 0.4};
    HelicopterMotion before = turning;
    before.p_n[2] = -0.2001;
    slowed.look(std::chrono::milliseconds(5), before, {});
    turning.v_b = {0, 0, 0.2};
    slowed.look(std::chrono::milliseconds(10), turning, {});
    CHECK(slowed.truth().touch_down == doctest::Approx(0.4).epsilon(1e-6).scale(0));
  }

  TEST_CASE("rotors that were ordered to lift it for 5 s, and did not, have never taken off") {
    CHECK(!driven(8000, 299).has_value());
    CHECK(!driven(7999, 4000).has_value());
    REQUIRE(driven(8000, 301).has_value());
    CHECK(driven(8000, 301)->text == "never taken off: its rotors were at 8000 or more of 16000 for 1.5 s");
    HelicopterParameters p;
    p.start.altitude = 1;
    Helicopter flying(p);
    for (int i = 0; i < 40; ++i) flying.step();
    CHECK(!flying.mishap().has_value());
  }

  TEST_CASE("the first mishap is the one that is reported") {
    HelicopterJudge judge({}, tilted(0));
    judge.look(nanoseconds(1), tilted(100 * degree), {});
    judge.look(nanoseconds(2), tilted(170 * degree), {});
    CHECK(judge.mishap()->text == "capsized: tilted by 100 deg, beyond 90 deg");
    CHECK(judge.mishap()->instant == nanoseconds(1));
  }

  TEST_CASE("a submarine has sunk beyond its depth, at the floor, and has capsized beyond a right angle") {
    SubmarineParameters deep_sea;
    deep_sea.sea.floor = 1000;
    CHECK(mishap_of({.z = 99.9}, deep_sea) == "");
    CHECK(mishap_of({.z = 100.1}, deep_sea) == "sunk: 100.1 m deep, beyond 100 m");
    CHECK(mishap_of({.phi = 89.9 * degree}, deep_sea) == "");
    CHECK(mishap_of({.phi = -90.1 * degree}, deep_sea) == "capsized: tilted by 90 deg, beyond 90 deg");
    // level, its underside is a radius of 75 mm below it; upright, half its length of 1.08 m
    CHECK(mishap_of({.z = 49.924}) == "");
    CHECK(mishap_of({.z = 49.926}) == "sunk: it touched the sea floor, 50 m deep");
    CHECK(mishap_of({.z = 49.459, .theta = 90 * degree}) == "");
    CHECK(mishap_of({.z = 49.461, .theta = 90 * degree}) == "sunk: it touched the sea floor, 50 m deep");
    SubmarineParameters vsim;
    vsim.vsim_compatible = true;
    CHECK(mishap_of({.z = 60}, vsim) == "");
  }

  TEST_CASE("true values are where it is, as its operator names it") {
    HelicopterMotion start = tilted(0, -0.2), now = tilted(0.3, -1.2);
    HelicopterJudge judge({}, start);
    now.p_n[0] = 2;
    now.v_b = {0.5, 0, 0};
    judge.look(nanoseconds(1), now, {});
    CHECK(judge.truth().roll == doctest::Approx(0.3));
    CHECK(judge.truth().tilt == doctest::Approx(0.3));
    CHECK(judge.truth().x == 2);
    CHECK(judge.truth().altitude == doctest::Approx(1));
    CHECK(judge.truth().speed == 0.5);
    // the lowest foot: 0.20 m out, 0.20 m down
    CHECK(judge.truth().height == doctest::Approx(1.2 - 0.2 * std::cos(0.3) - 0.2 * std::sin(0.3)));
    SubmarineJudge submarine({}, {});
    submarine.look(nanoseconds(1), {.z = 3, .theta = 0.1, .psi = 1, .u = 1.2});
    CHECK(submarine.truth().depth == 3);
    CHECK(submarine.truth().heading == 1);
    CHECK(submarine.truth().sinking == doctest::Approx(-1.2 * std::sin(0.1)));
    CHECK(submarine.truth().altitude == doctest::Approx(50 - 3 - 0.075 - 0.465 * std::sin(0.1)));
  }

  TEST_CASE("true values of a vehicle that leans and slips are what rotations make of them") {
    using Eigen::AngleAxisd, Eigen::Vector3d;
    const double phi = 0.5, theta = -0.3, psi = 2;
    const Eigen::Matrix3d R_nb =
        (AngleAxisd(psi, Vector3d::UnitZ()) * AngleAxisd(theta, Vector3d::UnitY()) * AngleAxisd(phi, Vector3d::UnitX()))
            .toRotationMatrix();
    const Vector3d v_b(1.2, -0.4, 0.3), v_n = R_nb * v_b;
    const double tilt = std::acos(R_nb(2, 2));
    SubmarineJudge submarine({}, {});
    submarine.look(nanoseconds(1), {.x = 4,
                                    .y = -5,
                                    .z = 3,
                                    .phi = phi,
                                    .theta = theta,
                                    .psi = psi,
                                    .u = v_b.x(),
                                    .v = v_b.y(),
                                    .w = v_b.z(),
                                    .r = 0.1});
    const SubmarineTruth& s = submarine.truth();
    CHECK(s.sinking == doctest::Approx(v_n.z()));
    CHECK(s.speed == 1.2);
    CHECK(s.roll == phi);
    CHECK(s.pitch == theta);
    CHECK(s.turn_rate == 0.1);
    CHECK(s.x == 4);
    CHECK(s.y == -5);

    HelicopterMotion motion;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        motion.R_nb[i][j] = R_nb(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    motion.p_n = {1, 2, -3};
    motion.v_b = {v_b.x(), v_b.y(), v_b.z()};
    HelicopterJudge helicopter({}, tilted(0, -1));
    helicopter.look(nanoseconds(1), motion, {});
    const HelicopterTruth& h = helicopter.truth();
    CHECK(h.roll == doctest::Approx(phi));
    CHECK(h.pitch == doctest::Approx(theta));
    CHECK(h.yaw == doctest::Approx(psi));
    CHECK(h.climb == doctest::Approx(-v_n.z()));
    CHECK(h.speed == doctest::Approx(std::hypot(v_n.x(), v_n.y())));
    CHECK(h.tilt == doctest::Approx(tilt));
    CHECK(h.y == 2);
    CHECK(h.altitude == doctest::Approx(2));
  }

  TEST_CASE("at rest is a helicopter whose lowest foot is within 10 cm of the ground") {
    const auto unrest = [](double altitude) {
      HelicopterParameters p;
      p.start.altitude = altitude;
      return Helicopter(p).unrest();
    };
    CHECK(unrest(0) == "");
    CHECK(unrest(0.09) == "");
    CHECK(unrest(0.85) == "it is 0.85 m above the ground");
  }

  TEST_CASE("at rest is a submarine within a metre of the surface") {
    const auto unrest = [](double depth) {
      SubmarineJudge judge({}, {.z = depth});
      return judge.unrest();
    };
    CHECK(unrest(0.99) == "");
    CHECK(unrest(-0.2) == "");
    CHECK(unrest(7.184) == "it is 7.18 m deep");
  }
}
