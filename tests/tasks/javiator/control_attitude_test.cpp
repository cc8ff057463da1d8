// The numbers of the helicopter's law of attitude: each gain and limit, by one step from a known state.
#include <doctest/doctest.h>

#include <cmath>

#include "tasks/javiator/control.h"
#include "tests/tasks/javiator/every_15_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;

using tests::dt;
using tests::tick;

// One axis of the three, which all follow the same law with numbers of their own.
struct Axis {
  double FlightEstimate::*angle, FlightEstimate::*rate, AttitudeGoal::*goal, TurnDemand::*demand;
  TurnModel AttitudeControl::State::*model;
  double bandwidth, effect, kp, kd, ki, limit, spin_time;
};

const Axis axes[] = {{&FlightEstimate::roll, &FlightEstimate::p, &AttitudeGoal::roll, &TurnDemand::roll,
                      &AttitudeControl::State::roll, 16, 153, 0.35, 0.09, 1.5, 0.5, 0},
                     {&FlightEstimate::pitch, &FlightEstimate::q, &AttitudeGoal::pitch, &TurnDemand::pitch,
                      &AttitudeControl::State::pitch, 16, 153, 0.35, 0.09, 1.5, 0.5, 0},
                     {&FlightEstimate::yaw, &FlightEstimate::r, &AttitudeGoal::yaw, &TurnDemand::yaw,
                      &AttitudeControl::State::yaw, 4, 12.3, 1, 0.55, 0.1, 0.25, 0.53}};

struct Attitude {
  const Axis& axis;
  AttitudeControl::State state{};
  AttitudeControl::Out out{};
  AttitudeControl::In in{.estimate = {.rates_known = true}};

  // The demand before it is smoothed over the spin of the rotors.
  double run(int periods = 1) {
    double given = 0;
    for (int i = 0; i < periods; ++i) {
      given = (state.*axis.model).given;
      AttitudeControl::run({}, tick, in, state, out);
    }
    return given + (out.turn.*axis.demand - given) * (axis.spin_time + dt) / dt;
  }
};
}  // namespace

TEST_SUITE("tasks/javiator_control/attitude") {
  TEST_CASE("an error of angle and one of rate are turned against by their gains") {
    for (const Axis& axis : axes) {
      for (const double side : {-1.0, 1.0}) {
        Attitude turned{axis};
        turned.in.estimate.*axis.angle = 0.01 * side;
        CHECK(turned.run() == doctest::Approx(-side * 0.01 * (axis.kp + axis.ki * dt)));
        Attitude turning{axis};
        turning.in.estimate.*axis.rate = 0.01 * side;
        CHECK(turning.run() == doctest::Approx(-side * 0.01 * axis.kd));
      }
    }
  }

  TEST_CASE("a heading that is counted anew is the same, and one that it was turned to while it stood is its own") {
    for (const double yaw : {6.283185307179586, 3.5, 1.0}) {
      CAPTURE(yaw);
      Attitude a{axes[2]};
      a.state.yaw.angle = yaw;
      a.in.estimate.yaw = yaw > 6 ? 0 : 0.2;
      a.in.goal.yaw = a.in.estimate.yaw;
      CHECK(a.run() == doctest::Approx(0).scale(1).epsilon(1e-12));
      CHECK(a.run(100) == doctest::Approx(0).scale(1).epsilon(1e-12));
    }
    // what wind turns it by in flight it turns back
    Attitude a{axes[2]};
    a.in.estimate.yaw = -0.2;
    CHECK(a.run() == doctest::Approx(0.2).scale(0).epsilon(0.01));
  }

  TEST_CASE("a goal is approached as a critically damped system of the second order would, whose effort is known") {
    for (const Axis& axis : axes) {
      Attitude a{axis};
      a.in.goal.*axis.goal = 1e-3;
      const double demand = a.run();
      const double acceleration = axis.bandwidth * axis.bandwidth * 1e-3;
      const TurnModel& model = a.state.*axis.model;
      CHECK(model.rate == doctest::Approx(acceleration * dt));
      CHECK(model.angle == doctest::Approx(acceleration * dt * dt / 2));
      CHECK(demand == doctest::Approx(acceleration / axis.effect + (axis.kp + axis.ki * dt) * model.angle +
                                      axis.kd * model.rate));
      Attitude moving{axis};
      (moving.state.*axis.model).rate = 1e-3;
      moving.run();
      CHECK((moving.state.*axis.model).rate == doctest::Approx(1e-3 * (1 - 2 * axis.bandwidth * dt)));
    }
  }

  TEST_CASE("the model asks for four fifths of what the rotors can give, the rest is for errors") {
    for (const Axis& axis : axes) {
      for (const double side : {-1.0, 1.0}) {
        Attitude a{axis};
        a.in.goal.*axis.goal = 3 * side;
        a.run();
        CHECK((a.state.*axis.model).rate == doctest::Approx(side * 0.8 * axis.limit * axis.effect * dt));
      }
    }
  }

  TEST_CASE("no more is demanded than the limit") {
    for (const Axis& axis : axes) {
      for (const double side : {-1.0, 1.0}) {
        Attitude a{axis};
        a.in.estimate.*axis.rate = 100 * side;
        CHECK(a.run() == doctest::Approx(-side * axis.limit));
      }
    }
  }

  TEST_CASE("the demand at rest is learnt up to a fifth of the limit, to either side") {
    for (const Axis& axis : axes) {
      for (const double side : {-1.0, 1.0}) {
        Attitude a{axis};
        a.in.estimate.*axis.angle = 0.1 * side;
        a.run(100000);
        CHECK((a.state.*axis.model).trim == -side * 0.2 * axis.limit);
      }
    }
  }

  TEST_CASE("blind, it keeps what held it level") {
    for (const Axis& axis : axes) {
      Attitude a{axis};
      a.state.*axis.model = {.trim = 0.03, .given = 0.03};
      a.in.estimate = {.rates_known = false};
      a.in.estimate.*axis.angle = 1;
      CHECK(a.run() == doctest::Approx(0.03));
    }
  }

  TEST_CASE("blind, it turns level and no further round, as one that sees itself do what its model does") {
    for (const Axis& axis : axes) {
      const TurnModel model{.angle = 0.1, .rate = -0.2, .trim = 0.02, .given = 0.02};
      const bool yaws = axis.spin_time > 0;
      Attitude seeing{axis}, blind{axis};
      seeing.state.*axis.model = blind.state.*axis.model = model;
      seeing.in.estimate.*axis.angle = model.angle;
      seeing.in.estimate.*axis.rate = model.rate;
      seeing.in.goal.*axis.goal = yaws ? model.angle : 0;
      blind.in.estimate.rates_known = false;
      blind.in.goal.*axis.goal = 0.3;
      CHECK(blind.run() == doctest::Approx(seeing.run()));
      blind.run(200);
      CHECK(std::abs((blind.state.*axis.model).rate) < 1e-3);
      CHECK((yaws || std::abs((blind.state.*axis.model).angle) < 1e-3));
    }
  }

  TEST_CASE("yaw turns more as rotors speed up than by their drag: its demand is smoothed over 0.53 s") {
    Attitude a{axes[2]};
    a.in.estimate.r = -0.1;
    a.run();
    CHECK(a.out.turn.yaw == doctest::Approx(0.055 * dt / (0.53 + dt)));
  }
}
