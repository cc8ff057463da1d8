// The end of a line that the vehicle comes past without having been there.
#include <doctest/doctest.h>

#include <cmath>

#include "tasks/lauv/guidance.h"
#include "tests/tasks/lauv/every_50_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;

// Turns at its rate at most.
struct Swimmer {
  LauvGuidance::In in{.leg = {.number = 1, .course = Course::line, .north = 80, .level = 3, .surge = 1.2},
                      .motion = {.u = 1.2}};
  LauvGuidance::State state;
  LauvGuidance::Out out;

  void step() {
    LauvGuidance::run({}, tests::every_50_ms, in, state, out);
    Motion& m = in.motion;
    m.psi = wrapped(m.psi + 0.05 * limited(wrapped(out.setpoint.heading - m.psi) / 1.25, 0.125));
    m.x += 0.05 * (m.u * std::cos(m.psi) + in.stream.north);
    m.y += 0.05 * (m.u * std::sin(m.psi) + in.stream.east);
  }
  // Until it is done. False: it is not, within ten minutes.
  bool swim() {
    for (int k = 0; k < 12000 && !out.progress.done; ++k) step();
    return out.progress.done;
  }
  double off() const { return std::hypot(in.motion.x - in.leg.north, in.motion.y - in.leg.east); }
};
}  // namespace

TEST_SUITE("tasks/lauv/guidance_miss") {
  TEST_CASE("who comes past the end of a line far off it turns, and is done where it reaches it") {
    // its place leaps aside, and aside and beyond, and straight ahead
    const double leaps[][2] = {{75, 60}, {140, 60}, {140, 0}};
    for (const auto& leap : leaps) {
      const double x = leap[0], y = leap[1];
      CAPTURE(x);
      CAPTURE(y);
      Swimmer s;
      for (int k = 0; k < 400; ++k) s.step();
      s.in.motion.x = x;
      s.in.motion.y = y;
      for (int k = 0; k < 200; ++k) s.step();
      CHECK_FALSE(s.out.progress.done);
      CHECK(s.swim());
      CHECK(s.off() < 3);
    }
  }

  TEST_CASE("a line is missed by 15 m, or twice the radius of its turn where that is more") {
    const auto is_done = [](double speed, double cross_track, double x = 80.5, double turn = 0) {
      Swimmer s;
      s.in.motion.u = s.in.leg.surge = speed;
      s.in.leg.turn = turn;
      s.step();
      s.in.motion.x = x;
      s.in.motion.y = cross_track;
      s.step();
      return s.out.progress.done;
    };
    CHECK(is_done(0.5, 14.5));
    CHECK_FALSE(is_done(0.5, 15.5));
    CHECK(is_done(1.2, -18.5));
    CHECK_FALSE(is_done(1.2, -20));
    // before a corner
    CHECK(is_done(1.2, 18.5, 75, 90 * degree));
    CHECK_FALSE(is_done(1.2, 20, 75, 90 * degree));
  }

  TEST_CASE("a corner is prepared by the course of its line, not by the one on which it is come back to") {
    Swimmer s;
    s.in.leg.turn = 90 * degree;
    for (int k = 0; k < 400; ++k) s.step();
    s.in.motion.x = 100;
    s.in.motion.y = 60;
    CHECK(s.swim());
    CHECK(s.off() < 3);
  }

  TEST_CASE("it comes to the end from wherever it has missed it, in a stream too") {
    for (int k = 0; k < 24; ++k) {
      CAPTURE(k);
      Swimmer s;
      s.step();
      s.in.stream = {0.5 * std::cos(2.0 * k), 0.5 * std::sin(2.0 * k)};
      s.in.motion.x = 81 + k;
      s.in.motion.y = k % 2 == 0 ? 20 + 2 * k : -20 - 2 * k;
      s.in.motion.psi = wrapped(0.7 * k);
      CHECK(s.swim());
      CHECK(s.off() < 20);
    }
  }
}
