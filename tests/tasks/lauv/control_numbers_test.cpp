// The numbers of the submarine's laws: each gain, sign and limit, against kinematics from rotations.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tasks/lauv/control.h"
#include "tests/tasks/lauv/every_50_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;

using tests::every_50_ms;

// R_nb from roll, pitch and yaw: turned about z, then y, then x (Fossen 2011, 2.18)
Eigen::Matrix3d rotation(const Motion& m) {
  return (Eigen::AngleAxisd(m.psi, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(m.theta, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(m.phi, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

double pitch_of(const Eigen::Matrix3d& R_nb) { return -std::asin(R_nb(2, 0)); }

// By turning the body on for a moment.
double pitch_rate_of(const Motion& m) {
  const double moment = 1e-5;
  const Eigen::Vector3d omega_b(m.p, m.q, m.r);
  const auto turned = [&](double t) {
    return (rotation(m) * Eigen::AngleAxisd(omega_b.norm() * t, omega_b.normalized())).eval();
  };
  return (pitch_of(turned(moment)) - pitch_of(turned(-moment))) / (2 * moment);
}

struct Depth {
  DepthControl::In in{};
  DepthControl::State state{};
  double run() {
    DepthControl::Out out;
    DepthControl::run({}, every_50_ms, in, state, out);
    return out.moment.angle;
  }
};

struct Heading {
  HeadingControl::In in{};
  HeadingControl::State state{};
  double run() {
    HeadingControl::Out out;
    HeadingControl::run({}, every_50_ms, in, state, out);
    return out.moment.angle;
  }
};

struct Speed {
  SpeedControl::In in{};
  SpeedControl::State state{};
  double run() {
    SpeedControl::Out out;
    SpeedControl::run({}, every_50_ms, in, state, out);
    return out.thrust.actuation;
  }
};

constexpr double fin_limit = 25 * degree, pitch_limit = 25 * degree;
}  // namespace

TEST_SUITE("tasks/lauv_control/numbers") {
  TEST_CASE("depth: the fins follow error, rate of depth, pitch and pitch rate of a vehicle that rolls and turns") {
    for (const double phi : {-0.3, 0.0, 0.4})
      for (const double r : {-0.2, 0.0, 0.25}) {
        CAPTURE(phi);
        CAPTURE(r);
        Depth c;
        c.in.setpoint.depth = 3;
        c.in.motion = {};
        Motion& m = c.in.motion;
        m.z = 2.9;
        m.phi = phi;
        m.theta = -0.06;
        m.psi = 1;
        m.u = 1.2;
        m.v = 0.15;
        m.w = -0.07;
        m.p = 0.05;
        m.q = 0.03;
        m.r = r;
        c.state.pitch_trim = 0.02;
        const double z_dot = (rotation(m) * Eigen::Vector3d(m.u, m.v, m.w)).z();
        const double theta = -0.45 * (3 - 2.9) + 0.45 * z_dot + 0.02;
        CHECK(c.run() == doctest::Approx(1.5 * (theta + 0.06) - 1.1 * pitch_rate_of(m)).scale(0).epsilon(1e-7));
        CHECK(c.state.pitch_trim == doctest::Approx(0.02 - 0.05 * 0.1 * 0.05));
      }
  }

  TEST_CASE("depth: the pitch demanded is limited, to either side and no earlier") {
    for (const double sign : {-1.0, 1.0}) {
      Depth c;
      // held at the limit, fins rest
      c.in.setpoint.depth = 100 * sign;
      c.in.motion.theta = -sign * pitch_limit;
      CHECK(c.run() == doctest::Approx(0));
      // an error that asks for just less
      c.in.setpoint.depth = sign * (pitch_limit / 0.45 - 0.01);
      CHECK(c.run() == doctest::Approx(1.5 * sign * 0.45 * 0.01));
      c.in.setpoint.depth = sign * (pitch_limit / 0.45 + 0.01);
      CHECK(c.run() == doctest::Approx(0));
    }
  }

  TEST_CASE("depth: the fins' angle is limited, to either side and no earlier") {
    for (const double sign : {-1.0, 1.0}) {
      Depth c;
      c.in.motion.q = -sign * (fin_limit / 1.1 - 0.001);
      CHECK(c.run() == doctest::Approx(sign * (fin_limit - 0.0011)));
      c.in.motion.q = -sign * (fin_limit / 1.1 + 0.001);
      CHECK(c.run() == sign * fin_limit);
    }
  }

  TEST_CASE("depth: the trim is learnt below half a metre of error, and no more than what half a metre takes back") {
    for (const double sign : {-1.0, 1.0}) {
      Depth c;
      c.in.setpoint.depth = sign * 0.501;
      c.run();
      CHECK(c.state.pitch_trim == 0);
      c.in.setpoint.depth = sign * 0.499;
      c.run();
      CHECK(c.state.pitch_trim == doctest::Approx(-sign * 0.05 * 0.499 * 0.05));
      for (int i = 0; i < 10'000; ++i) c.run();
      CHECK(c.state.pitch_trim == doctest::Approx(-sign * 0.9 * 0.45 * 0.5));
    }
  }

  TEST_CASE("heading: the fins follow the error of yaw rate that the error of heading asks for") {
    Heading c;
    c.in.setpoint.heading = 0.3;
    c.in.motion.psi = 0.1;
    c.in.motion.r = 0.05;
    CHECK(c.run() == doctest::Approx(1.2 * (0.8 * 0.2 - 0.05)));
  }

  TEST_CASE("heading: yaw rate and fins are limited, to either side and no earlier") {
    const double rate_limit = 20 * degree;
    for (const double sign : {-1.0, 1.0}) {
      Heading c;
      c.in.motion.r = sign * rate_limit;
      c.in.setpoint.heading = sign * (rate_limit / 0.8 - 0.01);
      CHECK(c.run() == doctest::Approx(-sign * 1.2 * 0.8 * 0.01));
      c.in.setpoint.heading = sign * (rate_limit / 0.8 + 0.01);
      CHECK(c.run() == doctest::Approx(0));
      c.in.setpoint.heading = 0;
      c.in.motion.r = -sign * (fin_limit / 1.2 - 0.001);
      CHECK(c.run() == doctest::Approx(sign * (fin_limit - 0.0012)));
      c.in.motion.r = -sign * (fin_limit / 1.2 + 0.001);
      CHECK(c.run() == sign * fin_limit);
    }
  }

  TEST_CASE("speed: the propeller follows the command, its error and the error's integral") {
    Speed c;
    c.in.setpoint.speed = 1;
    c.in.motion.u = 0.9;
    c.state.integral = 0.03;
    CHECK(c.run() == doctest::Approx(0.55 * 1 + 0.8 * 0.1 + 0.03));
    CHECK(c.state.integral == doctest::Approx(0.03 + 0.1 * 0.1 * 0.05));
  }

  TEST_CASE("speed: the propeller neither brakes nor exceeds its range, and the integral is held meanwhile") {
    Speed c;
    c.in.setpoint.speed = 0.5;
    c.in.motion.u = 2;
    CHECK(c.run() == 0);
    CHECK(c.state.integral == 0);
    c.in.motion.u = -1;
    CHECK(c.run() == 1);
    CHECK(c.state.integral == 0);
    c.in.setpoint.speed = 0;
    c.in.motion.u = -1;
    c.state.integral = 0.5;
    CHECK(c.run() == 0);
    CHECK(c.state.integral == 0);
  }

  TEST_CASE("driven astern against its command it puts all fins hard over: stern up, rudders to one side") {
    struct Case {
      double u;
      Drive drive;
      double thrust;
      bool hard_over;
    };
    for (const Case& c : {Case{-0.41, Drive::speed, 0, true},
                          {-0.41, Drive::thrust, 0.1, true},
                          {-0.41, Drive::thrust, -0.1, false},
                          {-0.39, Drive::speed, 0, false}}) {
      CAPTURE(c.u);
      CAPTURE(c.thrust);
      Depth depth;
      depth.in.motion = {.u = c.u};
      depth.state.surge = c.u;
      depth.in.setpoint = {.drive = c.drive, .thrust = c.thrust};
      CHECK(depth.run() == (c.hard_over ? 25 * degree : 0.0));
      Heading heading;
      heading.in.motion = {.u = c.u};
      heading.state.surge = c.u;
      heading.in.setpoint = {.drive = c.drive, .thrust = c.thrust};
      CHECK(heading.run() == (c.hard_over ? 25 * degree : 0.0));
    }
  }

  TEST_CASE("waves that move it to and fro are not what drives it astern, for seconds is") {
    Depth depth;
    Heading heading;
    for (int i = 0; i < 1200; ++i) {
      const double u = 0.7 * std::sin(2 * std::numbers::pi * 0.05 * i / 5);  // of waves of 1.1 m, 5 s apart
      depth.in.motion = heading.in.motion = {.u = u};
      REQUIRE(depth.run() == 0);
      REQUIRE(heading.run() == 0);
    }
    depth.state.surge = heading.state.surge = 0;
    depth.in.motion = heading.in.motion = {.u = -1};
    int periods = 0;
    for (; depth.run() == 0; ++periods) REQUIRE(heading.run() == 0);
    CHECK(heading.run() == 25 * degree);
    CHECK(periods * 50 == doctest::Approx(1500 * std::log(1 / 0.6)).epsilon(0.05).scale(0));  // ms
  }

  TEST_CASE("speed: a commanded thrust astern is limited, too") {
    Speed c;
    c.in.setpoint.drive = Drive::thrust;
    c.in.setpoint.thrust = -3;
    CHECK(c.run() == -1);
    c.in.setpoint.thrust = -0.99;
    CHECK(c.run() == -0.99);
  }
}
