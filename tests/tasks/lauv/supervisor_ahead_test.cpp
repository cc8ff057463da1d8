// The supervisor's limits of depth and altitude hold for where the submarine will be when it has levelled off.
#include <doctest/doctest.h>

#include <cmath>

#include "graph/math/geometry.h"
#include "tests/tasks/calm_submarine.h"
#include "tests/tasks/lauv/every_50_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;
using tests::calm_submarine;
using tests::every_50_ms;

// On its way at that depth and altitude along the beam, at that pitch, by its speed log.
LauvSupervisor::In under_way(double depth, double altitude, double theta, double u, double w = 0) {
  LauvSupervisor::In in = calm_submarine(1);
  in.instruments.depth.value = depth;
  in.instruments.pressure.value = 1013.25 + depth * 98.1;
  in.instruments.altitude.value = altitude;
  in.instruments.attitude.y = theta;
  in.instruments.velocity = {u, 0, w, 1};
  return in;
}

Alarm alarm_in(const LauvSupervisor::In& in) {
  LauvSupervisor::State state;
  LauvSupervisor::Out out;
  LauvSupervisor::run({}, every_50_ms, in, state, out);
  return out.condition.alarm;
}
}  // namespace

TEST_SUITE("tasks/lauv_supervisor/ahead") {
  TEST_CASE("one that sinks alarms where it would pass a limit on the 2.2 m of way in which it levels off") {
    const double theta = -20 * degree, beam = 1 / std::cos(theta);
    for (const double u : {0.6, 1.0, 2.0}) {
      for (const double w : {0.0, -0.1}) {
        CAPTURE(u);
        CAPTURE(w);
        const double sink = -u * std::sin(theta) + w * std::cos(theta), way_down = 2.2 * sink / u;
        CHECK(alarm_in(under_way(12 - way_down - 0.001, 50, theta, u, w)) == Alarm::none);
        CHECK(alarm_in(under_way(12 - way_down + 0.001, 50, theta, u, w)) == Alarm::depth_limit);
        CHECK(alarm_in(under_way(5, (2 + way_down + 0.001) * beam, theta, u, w)) == Alarm::none);
        CHECK(alarm_in(under_way(5, (2 + way_down - 0.001) * beam, theta, u, w)) == Alarm::altitude_limit);
      }
    }
  }

  TEST_CASE("one that comes up, or whose speed is not known, has no way down before it") {
    CHECK(alarm_in(under_way(11.9, 50, 20 * degree, 1)) == Alarm::none);
    CHECK(alarm_in(under_way(5, 2.2, 20 * degree, 1)) == Alarm::none);
    LauvSupervisor::In unheard = under_way(11.9, 50, -20 * degree, 1);
    unheard.instruments.velocity.count = 0;
    CHECK(alarm_in(unheard) == Alarm::none);
    unheard.instruments.velocity.count = 1;
    CHECK(alarm_in(unheard) == Alarm::depth_limit);
    unheard.instruments.attitude.count = 0;
    CHECK(alarm_in(unheard) == Alarm::none);
  }

  TEST_CASE("one that hardly goes ahead levels off as at half a metre a second: bobbing in waves is no dive") {
    CHECK(alarm_in(under_way(5, 2.44 - 0.001, 0, 0, 0.1)) == Alarm::altitude_limit);
    CHECK(alarm_in(under_way(5, 2.44 + 0.001, 0, 0, 0.1)) == Alarm::none);
    CHECK(alarm_in(under_way(5, 2.44 + 0.001, 0, -1, 0.1)) == Alarm::none);
  }

  TEST_CASE("what waves move it to and fro across the hull is no way down; what lasts for seconds is") {
    const auto alarm_after = [](Duration time, auto heave_at) {
      LauvSupervisor::State state;
      LauvSupervisor::Out out;
      for (int k = 0; k * 50ms < time && out.condition.alarm == Alarm::none; ++k) {
        LauvSupervisor::In in = under_way(5, 2.3, 0, 0, heave_at(0.05 * k));
        for (Reading* each : {&in.instruments.depth, &in.instruments.pressure, &in.instruments.altitude})
          each->count += k;
        LauvSupervisor::run({.sensor_timeout = 60}, every_50_ms, in, state, out);
      }
      return out.condition.alarm;
    };
    CHECK(alarm_after(60s, [](double s) { return 0.15 * std::sin(2 * pi * s / 2.5); }) == Alarm::none);
    const auto sinks = [](double s) { return s < 1 ? 0 : 0.15; };  // 0.3 m of way are 0.068 m/s
    CHECK(alarm_after(2s, sinks) == Alarm::none);
    CHECK(alarm_after(3s, sinks) == Alarm::altitude_limit);
    // what it does ahead counts at once, and so does that it levels off
    LauvSupervisor::State state;
    LauvSupervisor::Out out;
    LauvSupervisor::run({}, every_50_ms, under_way(11.5, 50, 0, 1), state, out);
    LauvSupervisor::run({}, every_50_ms, under_way(11.5, 50, -20 * degree, 1, -0.3), state, out);
    CHECK(out.condition.alarm == Alarm::none);
    LauvSupervisor::run({}, every_50_ms, under_way(11.5, 50, -20 * degree, 1), state, out);
    CHECK(out.condition.alarm == Alarm::depth_limit);
  }

  TEST_CASE("the altitude is that above the floor, not along the beam") {
    LauvSupervisor::In leaning = under_way(5, 2.3, 30 * degree, 0);
    CHECK(alarm_in(leaning) == Alarm::altitude_limit);
    leaning.instruments.altitude.value = 2.32;
    CHECK(alarm_in(leaning) == Alarm::none);
    leaning.instruments.attitude.x = 20 * degree;
    CHECK(alarm_in(leaning) == Alarm::altitude_limit);
  }
}
