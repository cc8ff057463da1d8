// What the submarine's laws make of parameters that others than the vehicles of specs/ have.
#include <doctest/doctest.h>

#include <cmath>

#include "graph/math/geometry.h"
#include "tasks/lauv/guidance.h"
#include "tasks/lauv/navigation.h"
#include "tests/tasks/calm_submarine.h"
#include "tests/tasks/lauv/every_50_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using tests::calm_submarine;
using tests::every_50_ms;

// The supervisor's inputs, step by step; what it has come to.
struct Watched {
  LauvSupervisor::Param param{};
  LauvSupervisor::State state{};
  LauvSupervisor::Out out{};
  std::int64_t k = 0;

  template <class Change>
  Alarm run(int steps, Change change) {
    for (int i = 0; i < steps; ++i) {
      LauvSupervisor::In in = calm_submarine(++k);
      change(in.instruments);
      LauvSupervisor::run(param, every_50_ms, in, state, out);
    }
    return out.condition.alarm;
  }
};

void as_it_is(Instruments&) {}

// One step of guidance on a leg.
LauvGuidance::Out steer(const LauvGuidance::Param& p, const Leg& leg, const Motion& motion, const Stream& stream = {}) {
  LauvGuidance::State state;
  LauvGuidance::Out out;
  LauvGuidance::run(p, every_50_ms, {.leg = leg, .motion = motion, .stream = stream}, state, out);
  return out;
}
}  // namespace

TEST_SUITE("tasks/lauv/parameters") {
  TEST_CASE("at sea the same pressure is less deep, and so it is where the air is heavier") {
    CHECK(calc_depth({.density = 1025}, 1013.25 + 98.1) == doctest::Approx(1 / 1.025));
    CHECK(calc_depth({.air_pressure = 1013.25 + 9.81}, 1013.25 + 98.1) == doctest::Approx(0.9));
    LauvNavigation::State state;
    LauvNavigation::Out out;
    Instruments i;
    i.depth.count = i.heading.count = -1;
    i.attitude.count = 1;
    i.pressure = {1013.25 + 981, 1};
    LauvNavigation::run({.water = {.density = 1025}}, every_50_ms, {i}, state, out);
    CHECK(out.motion.z == doctest::Approx(10 / 1.025));
  }

  TEST_CASE("the supervisor compares gauge and pressure in its water: 20 m of fresh water are 19.5 m at sea") {
    for (const bool at_sea : {true, false}) {
      Watched w;
      w.param.max_depth = 40;
      if (at_sea) w.param.reckoning.water.density = 1025;
      const Alarm alarm = w.run(40, [](Instruments& i) {
        i.depth.value = 20 / 1.025;
        i.pressure.value = 1013.25 + 20 * 98.1;
        i.altitude.value = 50 - i.depth.value;
      });
      CHECK(alarm == (at_sea ? Alarm::none : Alarm::depth_gauge));
    }
  }

  TEST_CASE("without a gauge the depth is that of the pressure in its water: 12.2 m of fresh water are 11.9 m at sea") {
    for (const bool at_sea : {true, false}) {
      Watched w;
      if (at_sea) w.param.reckoning.water.density = 1025;
      const Alarm alarm = w.run(40, [](Instruments& i) {
        i.depth.count = -1;
        i.pressure.value = 1013.25 + 12.2 * 98.1;
      });
      CHECK(alarm == (at_sea ? Alarm::none : Alarm::depth_limit));
    }
  }

  TEST_CASE("where one fix proves the surface, a deeper reading is wrong at once") {
    for (const std::int64_t fixes : {1, 2}) {
      LauvNavigation::State state;
      LauvNavigation::Out out;
      Instruments i;
      i.heading.count = i.pressure.count = -1;
      i.depth.value = 6;
      for (int k = 1; k < 10; ++k) {
        i.depth.count = i.attitude.count = k;
        i.place.count = k < 5 ? 0 : 1;
        LauvNavigation::run({.surface_fixes = fixes}, every_50_ms, {i}, state, out);
      }
      CHECK(state.depth.depth == (fixes == 1 ? 0.15 : 6));
    }
  }

  TEST_CASE("GPS has to report down to the depth that is given") {
    Watched w;
    w.param.fix_depth = 0.4;
    CHECK(w.run(90, [](Instruments& i) {
      i.depth.value = 0.39;
      i.pressure.value = 1013.25 + 0.39 * 98.1;
      i.altitude.value = 50 - 0.39;
    }) == Alarm::gps);
  }

  TEST_CASE("what the supervisor reckons follows attitude, floor and speed in its times") {
    Watched w;
    w.param.reckoning = {.angle_time = 4, .floor_time = 10, .drag_growth = 0};
    w.run(20, as_it_is);
    w.run(1, [](Instruments& i) {
      i.attitude.y = 0.08;
      i.forces = {9.81 * std::sin(0.08), 0, -9.81 * std::cos(0.08), i.forces.count};
      i.altitude.value = 46 / std::cos(0.08);
    });
    CHECK(w.state.theta == doctest::Approx(0.08 * 0.05 / 4));
    CHECK(w.state.floor == doctest::Approx(50 + 0.05 / 10));
    // with a drag that does not grow 150 rad/s, 4.725 N, drive it at 4.725 / 2.4 m/s
    w.run(4000, [](Instruments& i) {
      i.rpm.value = 150 * 30 / pi;
      i.velocity.x = 4.725 / 2.4;
    });
    CHECK(w.state.speed == doctest::Approx(4.725 / 2.4).scale(0).epsilon(1e-6));
  }

  TEST_CASE("it levels off as at its least speed, and averages its heave over its time") {
    const auto alarm = [](const LevellingOff& levelling, double first, double then) {
      Watched w;
      w.param.levelling = levelling;
      const auto sinking = [](double heave) {
        return [heave](Instruments& i) {
          i.velocity.z = heave;
          i.altitude.value = 2.3;
          i.depth.value = 5;
        };
      };
      w.run(1, sinking(first));
      return w.run(20, sinking(then));
    };
    // 2.2 m * 0.1 / 0.5 are more than the 30 cm that are left, / 0.8 less
    CHECK(alarm({}, 0.1, 0.1) == Alarm::altitude_limit);
    CHECK(alarm({.min_speed = 0.8}, 0.1, 0.1) == Alarm::none);
    CHECK(alarm({.heave_time = 0.5}, 0, 0.1) == Alarm::altitude_limit);
    CHECK(alarm({.heave_time = 20}, 0, 0.1) == Alarm::none);
  }

  TEST_CASE("a line joins the last one within its reaches and the radius of its turn") {
    for (const double joins : {1.0, 4.0}) {
      LauvGuidance::State state;
      LauvGuidance::Out out;
      LauvGuidance::In in{.leg = {.number = 1, .course = Course::line, .north = 50}, .motion = {.x = 47, .u = 1}};
      LauvGuidance::run({.joins = joins}, every_50_ms, in, state, out);
      in.leg = {.number = 2, .course = Course::line, .north = 50, .east = 50};
      LauvGuidance::run({.joins = joins}, every_50_ms, in, state, out);
      CHECK(state.begin_x == (joins == 1 ? 47 : 50));
    }
  }

  TEST_CASE("a corner is prepared up to the sharpest turn that is given, a stream met up to the greatest drift") {
    const Leg corner{.number = 1, .course = Course::line, .north = 100, .turn = 90 * degree};
    const auto done = [&](double max_turn, double left) {
      LauvGuidance::State state;
      LauvGuidance::Out out;
      LauvGuidance::In in{.leg = corner, .motion = {.u = 1}};
      LauvGuidance::run({.max_turn = max_turn}, every_50_ms, in, state, out);
      in.motion.x = 100 - left;
      LauvGuidance::run({.max_turn = max_turn}, every_50_ms, in, state, out);
      return out.progress.done;
    };
    CHECK(done(100 * degree, 7.9));  // of 8 m
    CHECK_FALSE(done(60 * degree, 7.9));
    CHECK(done(60 * degree, 8 * std::tan(30 * degree) - 0.1));

    const Leg line{.number = 1, .course = Course::line, .north = 100};
    const double heading = steer({.max_drift = 0.5}, line, {.u = 1}, {.east = 2}).setpoint.heading;
    CHECK(heading == doctest::Approx(-30 * degree));
  }

  TEST_CASE("who hardly goes ahead takes as long as at the least speed") {
    const Leg line{.number = 1, .course = Course::line, .north = 100};
    CHECK(steer({}, line, {}).progress.left == doctest::Approx(1000));
    CHECK(steer({.min_speed = 0.5}, line, {}).progress.left == doctest::Approx(200));
  }

  TEST_CASE("who hardly goes ahead heads into a stream, slips on a circle and goes down as at the least speed") {
    const LauvGuidance::Param p{.heading_time = 0, .min_speed = 0.5};
    const Leg line{.number = 1, .course = Course::line, .north = 100};
    CHECK(steer(p, line, {}, {.east = 0.2}).setpoint.heading == doctest::Approx(-std::asin(0.2 / 0.5)));
    const Leg circle{.number = 1, .course = Course::circle, .radius = 20};
    CHECK(steer(p, circle, {.x = 20, .v = 0.2}).setpoint.heading == doctest::Approx(pi / 2 - std::atan(0.2 / 0.5)));
    Leg down = line;
    down.level = 5;
    down.amplitude = 2;
    down.slope = 30 * degree;
    CHECK(steer(p, down, {.z = 4}).setpoint.depth == doctest::Approx(4 + 0.05 * 0.5 * 0.5).scale(0).epsilon(1e-6));
  }

  TEST_CASE("a station is driven back to as far as it is said, and at the surface within its edge") {
    LauvGuidance::Param p;
    p.station = {.back = 0.8, .edge = 5};
    LauvGuidance::State state;
    LauvGuidance::Out out;
    LauvGuidance::In in{.leg = {.number = 1, .course = Course::station, .radius = 10, .level = 3, .surge = 1},
                        .motion = {.u = 1}};
    const auto at = [&](double x) {
      in.motion.x = x;
      LauvGuidance::run(p, every_50_ms, in, state, out);
      return out.setpoint;
    };
    CHECK(at(8.1).speed == 1);
    CHECK(at(7.9).speed == 0);
    CHECK(at(49).depth == 0);
    CHECK(at(51).depth == 3);
  }

  TEST_CASE("the time at a station counts within its edge") {
    LauvGuidance::Param p;
    p.station.edge = 5;
    LauvGuidance::State state;
    LauvGuidance::Out out;
    LauvGuidance::In in{.leg = {.number = 1, .course = Course::station, .radius = 10, .duration = 10}};
    const auto left_at = [&](double x) {
      in.motion.x = x;
      LauvGuidance::run(p, every_50_ms, in, state, out);
      return out.progress.left;
    };
    CHECK(left_at(9) == doctest::Approx(9.95));
    CHECK(left_at(49) == doctest::Approx(9.9));
    CHECK(left_at(51) == doctest::Approx(9.9));
  }
}
