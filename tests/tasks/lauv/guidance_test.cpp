#include "tasks/lauv/guidance.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/tasks/lauv/every_50_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;

using tests::every_50_ms;

// A vehicle that goes ahead at once where it is steered, at a speed through a stream.
struct Vehicle {
  LauvGuidance::In in{.motion = {.u = 1.2}};
  LauvGuidance::State state;
  LauvGuidance::Out out;

  void step(int times = 1) {
    for (; times > 0; --times) {
      LauvGuidance::run({}, every_50_ms, in, state, out);
      Motion& m = in.motion;
      m.psi += 0.05 / 1.25 * wrapped(out.setpoint.heading - m.psi);
      m.x += 0.05 * (m.u * std::cos(m.psi) + in.stream.north);
      m.y += 0.05 * (m.u * std::sin(m.psi) + in.stream.east);
      m.z += 0.05 * limited(out.setpoint.depth - m.z, 0.4);
    }
  }
};

Leg line(std::uint32_t number, double x, double y) {
  return {.number = number, .course = Course::line, .north = x, .east = y, .level = 3, .surge = 1.2};
}
}  // namespace

TEST_SUITE("tasks/lauv_guidance") {
  TEST_CASE("without a leg the operator's setpoint goes through as it is") {
    LauvGuidance::In in;
    in.setpoint = {3, 0.5, 1.1, Turn::rate, 0.2, Drive::thrust, 0.4};
    LauvGuidance::State state{.number = 7, .sigma = 1};
    LauvGuidance::Out out;
    out.progress.done = true;
    LauvGuidance::run({}, every_50_ms, in, state, out);
    CHECK(out.setpoint.depth == 3);
    CHECK(out.setpoint.turn == Turn::rate);
    CHECK(out.setpoint.thrust == 0.4);
    CHECK(out.progress.on_leg == 0);
    CHECK_FALSE(out.progress.done);
    CHECK(state.sigma == 0);
  }

  TEST_CASE("beside a line it steers for the point a lookahead further on it") {
    Vehicle v;
    v.in.leg = line(1, 100, 0);
    v.step();
    v.in.motion = {.x = 20, .y = 5, .u = 1.2};
    LauvGuidance::run({.lookahead = 5, .integral = 0}, every_50_ms, v.in, v.state, v.out);
    CHECK(v.out.setpoint.heading == doctest::Approx(-45 * degree));
    CHECK(v.out.progress.cross_track == doctest::Approx(5));
    CHECK(v.out.progress.distance == doctest::Approx(std::hypot(80, 5)));
    CHECK(v.out.progress.left == doctest::Approx(80 / 1.2));
    CHECK(v.out.setpoint.depth == 3);
    CHECK(v.out.setpoint.speed == 1.2);
  }

  TEST_CASE("in a stream across it keeps the line at a drift angle, known or learnt") {
    for (const bool known : {true, false}) {
      CAPTURE(known);
      Vehicle v;
      v.in.leg = line(1, 1000, 0);
      const Stream real{0, 0.3};
      for (int k = 0; k < 6000; ++k) {
        v.in.stream = known ? real : Stream{};
        LauvGuidance::run({}, every_50_ms, v.in, v.state, v.out);
        Motion& m = v.in.motion;
        m.psi = v.out.setpoint.heading;
        m.x += 0.05 * 1.2 * std::cos(m.psi);
        m.y += 0.05 * (1.2 * std::sin(m.psi) + real.east);
        if (known) CHECK(std::abs(m.y) < 0.02);
      }
      CHECK(std::abs(v.in.motion.y) < 0.1);
      CHECK(v.in.motion.psi == doctest::Approx(-std::asin(0.3 / 1.2)).scale(0).epsilon(0.05));
    }
  }

  TEST_CASE("on a circle it stays at its radius, on the side that its sign says") {
    for (const double radius : {20.0, -20.0}) {
      CAPTURE(radius);
      Vehicle v;
      v.in.leg = {
          .number = 1, .course = Course::circle, .north = 50, .east = 10, .radius = radius, .level = 3, .surge = 1.2};
      v.step(3000);
      for (int k = 0; k < 2000; ++k) {
        v.step();
        CHECK(std::abs(v.out.progress.cross_track) < 0.1);
        CHECK(std::hypot(v.in.motion.x - 50, v.in.motion.y - 10) == doctest::Approx(20).scale(0).epsilon(0.01));
      }
      const double before = v.in.motion.psi;
      v.step(10);
      CHECK((wrapped(v.in.motion.psi - before) > 0) == (radius > 0));
      CHECK(v.out.progress.left == -1);
      CHECK_FALSE(v.out.progress.done);
    }
  }

  TEST_CASE("a circle with a duration ends so long after the vehicle came to it") {
    Vehicle v;
    v.in.leg = {
        .number = 1, .course = Course::circle, .north = 60, .radius = 10, .duration = 30, .level = 3, .surge = 1.2};
    int steps = 0, there = 0;
    for (; steps < 4000 && !v.out.progress.done; ++steps) {
      v.step();
      if (there == 0 && v.out.progress.near) there = steps;
    }
    CHECK(there > 600);
    CHECK((steps - there) * 0.05 == doctest::Approx(30).scale(0).epsilon(0.01));
  }

  TEST_CASE("a line joins the last one where the vehicle is near its end, and else begins where it is") {
    Vehicle v;
    v.in.leg = line(1, 50, 0);
    v.step(10);
    v.in.motion.x = 49;
    v.in.motion.y = 1;
    v.step();
    CHECK(v.out.progress.done);
    v.in.leg = line(2, 50, 50);
    v.step();
    CHECK(v.state.begin_x == 50);
    CHECK(v.state.begin_y == 0);
    v.in.motion.x = 100;
    v.in.motion.y = 100;
    v.in.leg = line(3, 0, 0);
    v.step();
    CHECK(v.state.begin_x == doctest::Approx(100).scale(0).epsilon(0.01));
  }

  TEST_CASE("where the course turns a line ends before its end, by as much as the turn takes; else at its end") {
    const auto ends_at = [](double turn) {
      Vehicle v;
      v.in.leg = line(1, 50, 0);
      v.in.leg.turn = turn;
      while (!v.out.progress.done) v.step();
      return v.in.motion.x;
    };
    CHECK(ends_at(0) == doctest::Approx(48).scale(0).epsilon(0.01));  // where it is reached
    CHECK(ends_at(90 * degree) == doctest::Approx(50 - 1.2 / 0.125).scale(0).epsilon(0.01));
    CHECK(ends_at(-90 * degree) == doctest::Approx(50 - 1.2 / 0.125).scale(0).epsilon(0.01));
  }

  TEST_CASE("up and down it goes between both depths at its pitch") {
    Vehicle v;
    v.in.leg = line(1, 1000, 0);
    v.in.leg.level = 5;
    v.in.leg.amplitude = 2;
    v.in.leg.slope = 10 * degree;
    double min = 1e9, greatest = 0, last = 0, steepest = 0;
    for (int k = 0; k < 8000; ++k) {
      v.step();
      if (k > 1000) min = std::min(min, v.in.motion.z);
      greatest = std::max(greatest, v.in.motion.z);
      if (k > 0) steepest = std::max(steepest, std::abs(v.out.setpoint.depth - last) / 0.05);
      last = v.out.setpoint.depth;
    }
    CHECK(min == doctest::Approx(3.3).scale(0).epsilon(0.05));
    CHECK(greatest == doctest::Approx(6.7).scale(0).epsilon(0.05));
    CHECK(steepest == doctest::Approx(1.2 * std::sin(10 * degree)).scale(0).epsilon(0.01));
  }

  TEST_CASE("an altitude is kept over a floor that rises; without an altimeter the depth is") {
    Vehicle v;
    v.in.leg = line(1, 1000, 0);
    v.in.leg.vertical = Vertical::altitude;
    v.in.leg.level = 4;
    v.in.motion.z = 10;
    v.step();
    CHECK(v.out.setpoint.depth == 10);
    v.in.instruments.altitude = {6, 1};
    v.in.motion.theta = 60 * degree;
    v.step();
    CHECK(v.out.setpoint.depth == doctest::Approx(10 + 6 * 0.5 - 4));
  }

  TEST_CASE("an altitude is not reached before the altimeter has reported one") {
    for (const std::int64_t count : {-1, 0}) {
      Vehicle v;
      v.in.leg = {.number = 1,
                  .course = Course::circle,
                  .radius = 10,
                  .until_level = true,
                  .vertical = Vertical::altitude,
                  .level = 4,
                  .surge = 1};
      v.in.motion.z = 2;
      v.in.instruments.altitude.count = count;
      v.step(20);
      CHECK_FALSE(v.out.progress.levelled);
      CHECK_FALSE(v.out.progress.done);
      v.in.instruments.altitude = {4.2, 1};
      v.step();
      CHECK(v.out.progress.levelled);
      CHECK(v.out.progress.done);
    }
  }

  TEST_CASE("at its station the propeller stops until it has drifted to the edge") {
    Vehicle v;
    v.in.leg = {.number = 1, .course = Course::station, .north = 30, .radius = 10, .surge = 1};
    v.step();
    CHECK(v.out.setpoint.speed == 1);
    v.in.motion.x = 24;
    v.step();
    CHECK(v.out.setpoint.speed == 1);  // on to half of the radius
    v.in.motion.x = 26;
    v.step();
    CHECK(v.out.setpoint.speed == 0);
    v.in.motion.x = 21;
    v.step();
    CHECK(v.out.setpoint.speed == 0);
    v.in.motion.x = 19;
    v.step();
    CHECK(v.out.setpoint.speed == 1);
  }

  TEST_CASE("a station is driven to at its depth, and back to at the surface within 2.5 of its radii") {
    Vehicle v;
    v.in.leg = {.number = 1, .course = Course::station, .north = 30, .radius = 10, .level = 3, .surge = 1};
    v.in.motion.x = 9;
    v.step();
    CHECK(v.out.setpoint.depth == 3);
    v.in.motion.x = 26;
    v.step();
    CHECK(v.out.setpoint.depth == 0);
    v.in.motion.x = 5.1;
    v.step();
    CHECK(v.out.setpoint.depth == 0);
    v.in.motion.x = 4.9;
    v.step();
    CHECK(v.out.setpoint.depth == 3);
  }

  TEST_CASE(
      "at a station or on a circle the time counts that it is within 2.5 radii, or 15 m, not that it is swept away") {
    for (const Course course : {Course::station, Course::circle}) {
      CAPTURE(static_cast<int>(course));
      Vehicle v;
      v.in.leg = {.number = 1, .course = course, .radius = 10, .duration = 10, .level = 3, .surge = 1};
      const auto stay = [&](double x, int steps) {
        for (; steps > 0; v.step(), --steps) v.in.motion.x = x, v.in.motion.y = 0;
      };
      stay(9, 40);
      stay(24.9, 60);
      CHECK(v.out.progress.left == doctest::Approx(5));
      stay(25.1, 2000);
      CHECK_FALSE(v.out.progress.done);
      CHECK(v.out.progress.left == doctest::Approx(5));
      stay(9, 98);
      CHECK_FALSE(v.out.progress.done);
      stay(9, 4);
      CHECK(v.out.progress.done);
    }
  }

  TEST_CASE("for a fix the propeller is off until GPS has found it once more; without GPS it does not wait") {
    Vehicle v;
    v.in.instruments.place.count = 7;
    v.in.leg = {.number = 1, .course = Course::fix, .duration = 1, .surge = 1};
    for (int k = 0; k < 100; ++k) v.step();
    CHECK(v.out.setpoint.speed == 0);
    CHECK_FALSE(v.out.progress.done);
    v.in.instruments.place.count = 8;
    v.step();
    CHECK(v.out.progress.done);
    v.in.instruments.place.count = -1;
    v.in.leg.number = 2;
    v.step();
    CHECK(v.out.progress.done);
  }

  TEST_CASE("a leg that ends at its depth is over as soon as that is reached") {
    Vehicle v;
    v.in.leg = {.number = 1, .course = Course::circle, .radius = 10, .until_level = true, .level = 4, .surge = 1};
    v.in.motion.z = 2;
    while (!v.out.progress.done && v.in.motion.x < 1000) v.step();
    CHECK(v.in.motion.z == doctest::Approx(3.7).scale(0).epsilon(0.01));
  }

  TEST_CASE("at rest the propeller is off, for its time") {
    Vehicle v;
    v.in.leg = {.number = 1, .course = Course::rest, .duration = 5, .surge = 1, .thrust = 1};
    int steps = 0;
    for (; !v.out.progress.done; ++steps) v.step();
    CHECK(std::abs(steps - 100) <= 1);
    CHECK(v.out.setpoint.speed == 0);
    CHECK(v.out.setpoint.thrust == 0);
  }
}
