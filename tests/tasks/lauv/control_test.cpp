#include "tasks/lauv/control.h"

#include <doctest/doctest.h>

TEST_SUITE("tasks/lauv_control") {
  using namespace jarol;
  using namespace jarol::tasks;
  using namespace std::chrono_literals;

  const Tick tick{0ms, 0, 50ms};

  TEST_CASE("too shallow noses down, too deep noses up") {
    DepthControl::State state;
    DepthControl::Out out;
    DepthControl::In in;
    in.setpoint.depth = 3;
    DepthControl::run({}, tick, in, state, out);
    CHECK(out.moment.angle < 0);
    in.motion.z = 6;
    DepthControl::run({}, tick, in, state, out);
    CHECK(out.moment.angle > 0);
  }

  TEST_CASE("the integral of depth works only within reach, so that a dive does not wind it up") {
    DepthControl::State state;
    DepthControl::Out out;
    DepthControl::In in;
    in.setpoint.depth = 3;
    for (int i = 0; i < 100; ++i) DepthControl::run({}, tick, in, state, out);
    CHECK(state.pitch_trim == 0);
    in.motion.z = 2.9;
    DepthControl::run({}, tick, in, state, out);
    CHECK(state.pitch_trim == doctest::Approx(-DepthControl::Param{}.ki * 0.1 * 0.05));
  }

  TEST_CASE("what the integral of depth has learnt at rest, where it moves nothing, does not keep it out of reach") {
    DepthControl::Param param;
    SUBCASE("as it is") {}
    SUBCASE("with another gain") { param.kp = 0.2; }
    DepthControl::State state;
    DepthControl::Out out;
    DepthControl::In in;
    in.motion.z = 0.07;  // afloat
    for (int i = 0; i < 10'000; ++i) DepthControl::run(param, tick, in, state, out);
    CHECK(state.pitch_trim > 0.08);
    // there, short of the depth, it would stay
    const double short_of = state.pitch_trim / param.kp;
    in.setpoint.depth = 3;
    in.motion.z = 3 - short_of;
    DepthControl::run(param, tick, in, state, out);
    CHECK(state.pitch_trim / param.kp < short_of);
  }

  TEST_CASE("a turn takes the shorter way round") {
    HeadingControl::Out out;
    HeadingControl::In in;
    HeadingControl::State state;
    in.motion.psi = 170 * degree;
    in.setpoint.heading = -170 * degree;
    HeadingControl::run({}, tick, in, state, out);
    CHECK(out.moment.angle > 0);  // to starboard, through south
    in.setpoint.heading = 150 * degree;
    HeadingControl::run({}, tick, in, state, out);
    CHECK(out.moment.angle < 0);
  }

  TEST_CASE("a commanded rate turns whatever the heading") {
    HeadingControl::Out out;
    HeadingControl::In in;
    HeadingControl::State state;
    in.setpoint = {.heading = -1, .turn = Turn::rate, .rate = 0.1};
    HeadingControl::run({}, tick, in, state, out);
    CHECK(out.moment.angle == doctest::Approx(HeadingControl::Param{}.rate_kp * 0.1));
    in.motion.r = 0.1;
    HeadingControl::run({}, tick, in, state, out);
    CHECK(out.moment.angle == 0);
    in.setpoint.rate = 10;
    in.motion.r = HeadingControl::Param{}.rate_limit;
    HeadingControl::run({}, tick, in, state, out);
    CHECK(out.moment.angle == 0);
  }

  TEST_CASE("a demand never exceeds the fins' limit") {
    HeadingControl::Out out;
    HeadingControl::In in;
    HeadingControl::State state;
    in.setpoint.heading = 90 * degree;
    in.motion.r = -2;
    HeadingControl::run({}, tick, in, state, out);
    CHECK(out.moment.angle == HeadingControl::Param{}.fin_limit);
  }

  TEST_CASE("no commanded speed stops the propeller and forgets the integral") {
    SpeedControl::State state{0.4};
    SpeedControl::Out out;
    SpeedControl::run({}, tick, {}, state, out);
    CHECK(out.thrust.actuation == 0);
    CHECK(state.integral == 0);
  }

  TEST_CASE("a commanded thrust goes to the propeller as it is, within its limits, and forgets the integral") {
    SpeedControl::State state{0.4};
    SpeedControl::Out out;
    SpeedControl::In in;
    in.setpoint = {.speed = 1.2, .drive = Drive::thrust, .thrust = -0.4};
    SpeedControl::run({}, tick, in, state, out);
    CHECK(out.thrust.actuation == -0.4);
    CHECK(state.integral == 0);
    in.setpoint.thrust = 3;
    SpeedControl::run({}, tick, in, state, out);
    CHECK(out.thrust.actuation == 1);
  }

  TEST_CASE("the integral of speed is held while the propeller is saturated") {
    SpeedControl::State state;
    SpeedControl::Out out;
    SpeedControl::In in;
    in.setpoint.speed = 1.8;
    SpeedControl::run({}, tick, in, state, out);
    CHECK(out.thrust.actuation == 1);
    CHECK(state.integral == 0);
    in.motion.u = 1.7;
    SpeedControl::run({.feed_forward = 0.5}, tick, in, state, out);
    CHECK(state.integral > 0);
  }

  TEST_CASE("nose up and a turn to starboard take negative angles of their fins") {
    FinAllocator::Out out;
    FinAllocator::run(tick, {.pitch = {0.1}, .yaw = {0.2}, .thrust = {0.5}}, out);
    CHECK(out.actuation.fins == std::array{-0.2, -0.1, -0.1, -0.2});
    CHECK(out.actuation.thruster == 0.5);
  }

  TEST_CASE("the report is the motion in the operator's terms") {
    LauvReport::In in;
    in.motion.z = 3;
    in.motion.theta = 0.1;
    in.motion.psi = 0.2;
    in.motion.u = 1.2;
    LauvReport::Out out;
    LauvReport::run(tick, in, out);
    CHECK(out.report.depth == 3);
    CHECK(out.report.pitch == 0.1);
    CHECK(out.report.heading == 0.2);
    CHECK(out.report.speed == 1.2);
  }
}
