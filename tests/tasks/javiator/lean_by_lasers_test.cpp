// What the helicopter's filter and laws do with a lean that lasers show, as the IMU is lost.
#include <doctest/doctest.h>

#include <cmath>

#include "tasks/javiator/altitude_control.h"
#include "tasks/javiator/control.h"
#include "tests/tasks/heard_helicopter.h"
#include "tests/tasks/javiator/every_15_ms.h"
#include "tests/tasks/javiator/hovering_law.h"

namespace {
using namespace jarol::tasks;
using jarol::tests::Altitude;
using jarol::tests::dt;
using jarol::tests::g_earth;
using jarol::tests::HeardHelicopter;
using jarol::tests::hovering;
using jarol::tests::tick;

Altitude landing_blind() {
  Altitude a;
  a.in.estimate.rates_known = false;
  a.in.estimate.lean_known = true;
  a.in.directive.state = FlightState::landing;
  return a;
}

// A filter whose IMU is lost, and what the observer says meanwhile.
FlightEstimate estimate_of(const BlindMotion& blind, double trim = 0, double sonar_off = 0) {
  HeardHelicopter heard = hovering();
  heard.directive.trim_roll = heard.directive.trim_pitch = trim;
  heard.sensors.new_imu = false;
  heard.run(10);
  ++heard.sensors.answers;
  heard.sensors.sonar += sonar_off;
  JaviatorFilter::run(heard.param, tick, {heard.sensors, heard.directive, blind}, heard.state, heard.out);
  return heard.out.estimate;
}
}  // namespace

TEST_SUITE("tasks/lean_by_lasers") {
  TEST_CASE("without an IMU the filter takes lean, rates, place and speed that the lasers show, if they do") {
    const BlindMotion blind{.roll = 0.05,
                            .pitch = -0.1,
                            .yaw = 0.2,
                            .p = 0.3,
                            .q = -0.2,
                            .r = 0.1,
                            .x = 0.01,
                            .y = 0.02,
                            .v_x = 0.3,
                            .v_y = -0.4,
                            .drag_x = 0.5,
                            .drag_y = -0.6,
                            .lift = 9.9,
                            .known = true};
    const FlightEstimate e = estimate_of(blind);
    CHECK(e.lean_known);
    CHECK_FALSE(e.rates_known);
    CHECK_FALSE(e.attitude_known);
    CHECK(e.roll == doctest::Approx(0.05 + 0.02 * 0.3));
    CHECK(e.pitch == doctest::Approx(-0.1 - 0.02 * 0.2));
    CHECK(e.yaw == doctest::Approx(0.2 + 0.02 * 0.1));
    CHECK(e.p == 0.3);
    CHECK(e.x == 0.01);
    CHECK(e.y == 0.02);
    CHECK(e.v_x == 0.3);
    CHECK(e.v_y == -0.4);
    CHECK(e.drag_x == doctest::Approx(0.5).epsilon(0.05).scale(0));
    CHECK(e.drag_y == doctest::Approx(-0.6).epsilon(0.05).scale(0));
    // they show the lean itself, not what an IMU reports of it
    CHECK(estimate_of(blind, 0.03).roll == doctest::Approx(e.roll));
    CHECK(estimate_of(blind, 0.03).pitch == doctest::Approx(e.pitch));
    BlindMotion unknown = blind;
    unknown.known = false;
    const FlightEstimate without = estimate_of(unknown);
    CHECK_FALSE(without.lean_known);
    CHECK(without.p == 0);
    CHECK(std::abs(without.x) < 0.001);
  }

  TEST_CASE(
      "a sonar that jumps by 15 cm is believed if nobody knows how it climbs, but not while lasers show how it leans") {
    const auto climbed = [](bool known, double sonar_off) {
      const BlindMotion blind{.lift = g_earth, .known = known};
      return estimate_of(blind, 0, sonar_off).altitude - estimate_of(blind).altitude;
    };
    CHECK(climbed(false, 0.15) > 0.02);
    CHECK(std::abs(climbed(true, 0.15)) < 1e-9);
    // the observer of altitude is quick then, 20 rad/s, as nobody feels gusts
    CHECK(climbed(true, 0.05) == doctest::Approx(0.05 * (1 - std::exp(-3 * 20 * dt))).epsilon(0.01).scale(0));
  }

  TEST_CASE("a fix grows with the lean to its wall by what the ray points down, and with the yaw by what it is askew") {
    const FlightEstimate e = estimate_of({.roll = 0.05, .pitch = 0.1, .lift = g_earth, .known = true});
    CHECK(e.fixes[0].is_new);
    CHECK(e.fixes[1].is_new);
    CHECK(e.fixes[0].slope == doctest::Approx(0.08 - 8.07 * std::sin(0.1)));
    CHECK(e.fixes[1].slope == doctest::Approx(0.08 + 8.077 * std::sin(0.05) * std::cos(0.1)));
    CHECK(e.fixes[0].range == doctest::Approx(8.07 * std::cos(0.1)));
    CHECK(e.fixes[1].range == doctest::Approx(8.077 * std::cos(0.05)));
    CHECK(std::abs(e.fixes[0].skew) < 1e-9);
  }

  TEST_CASE("the place is held softly, by 0.6/s^2 and 1.5/s") {
    PositionControl::In in{.estimate = {.x = -0.1, .altitude = 1, .v_y = 0.2, .lean_known = true},
                           .directive = {.state = FlightState::landing, .hold_position = true}};
    PositionControl::State state{.holding = true};
    PositionControl::Out out{};
    PositionControl::run({}, tick, in, state, out);
    CHECK(-g_earth * std::tan(out.goal.pitch) == doctest::Approx(0.6 * 0.1).epsilon(0.01).scale(0));
    CHECK(g_earth * std::tan(out.goal.roll) == doctest::Approx(-1.5 * 0.2).epsilon(0.01).scale(0));
  }

  TEST_CASE(
      "near the ground a landing leans less: by 40 % from 10 cm down to 3 cm, in flight and with an IMU by nothing") {
    const auto pitch = [](FlightState doing, bool lean_known, double altitude) {
      PositionControl::In in{.estimate = {.x = -0.1, .altitude = altitude, .lean_known = lean_known},
                             .directive = {.state = doing, .hold_position = true}};
      PositionControl::State state{.holding = true};
      PositionControl::Out out{};
      PositionControl::run({}, tick, in, state, out);
      return out.goal.pitch;
    };
    const double full = pitch(FlightState::landing, true, 0.1);
    CHECK(full == pitch(FlightState::flying, true, 0.01));
    CHECK(pitch(FlightState::landing, true, 0.065) == doctest::Approx(0.8 * full).epsilon(1e-9));
    CHECK(pitch(FlightState::landing, true, 0.03) == doctest::Approx(0.6 * full).epsilon(1e-9));
    CHECK(pitch(FlightState::landing, true, 0.0) == doctest::Approx(0.6 * full).epsilon(1e-9));
    CHECK(pitch(FlightState::landing, false, 0.01) == pitch(FlightState::flying, false, 0.01));
  }

  TEST_CASE("it turns to what is commanded as with an IMU, but below 4 cm, where a foot may stand") {
    const auto demand = [](bool rates, bool lean, double altitude) {
      AttitudeControl::In in{.estimate = {.roll = 0.1, .altitude = altitude, .rates_known = rates, .lean_known = lean}};
      AttitudeControl::State state{};
      AttitudeControl::Out out{};
      AttitudeControl::run({}, tick, in, state, out);
      return out.turn.roll;
    };
    CHECK(demand(false, true, 0.041) == demand(true, false, 0.041));
    CHECK(demand(false, true, 0.041) < -0.03);
    CHECK(demand(false, true, 0.039) == 0);
    CHECK(demand(false, false, 1) == 0);
  }

  TEST_CASE("a landing begins with 5 m/s^2, and slows with 2.5 m/s^2 to 15 cm/s at 10 cm") {
    Altitude high = landing_blind();
    high.run();
    CHECK(high.state.z.speed == doctest::Approx(-5 * dt));
    high.run(100);
    CHECK(high.state.z.speed == doctest::Approx(-1.6));
    for (const auto& [altitude, speed] :
         {std::pair{0.4, std::sqrt(0.15 * 0.15 + 5 * 0.3)}, {0.1, 0.15}, {0.05, 0.15}}) {
      Altitude low = landing_blind();
      low.in.estimate.altitude = altitude;
      low.run(200);
      CHECK(low.state.z.speed == doctest::Approx(-speed));
    }
  }

  TEST_CASE("below 45 mm it takes back its thrust by 1.4/s, and has it again above") {
    Altitude a = landing_blind();
    a.in.estimate.altitude = 0.0449;
    a.run(10);
    CHECK(a.state.foot_cut == doctest::Approx(1.4 * 10 * dt));
    CHECK(a.run(200) == 0);
    a.in.estimate.altitude = 0.0451;
    a.run();
    CHECK(a.state.foot_cut == 0);
  }

  TEST_CASE("where it may stand it demands 4 m/s^2 upwards at most, whatever one range makes of its climb") {
    Altitude a = landing_blind();
    a.in.estimate.climb = -2;
    a.in.estimate.altitude = 0.0451;
    CHECK(a.run() > 1.9);
    a.in.estimate.altitude = 0.0449;
    const double thrust = a.run();
    CHECK(thrust == doctest::Approx(a.state.trim + 4 / g_earth - a.state.foot_cut));
  }

  TEST_CASE("an error of altitude is 20/s^2 then, and 12/s^2 with an IMU") {
    const auto thrust = [](bool lean_known, double altitude) {
      Altitude a = landing_blind();
      a.in.estimate.lean_known = lean_known;
      a.in.estimate.rates_known = !lean_known;
      a.in.estimate.altitude = altitude;
      return a.run();
    };
    CHECK(thrust(true, 0.99) - thrust(true, 1) == doctest::Approx((20 + dt) * 0.01 / g_earth));
    CHECK(thrust(false, 0.99) - thrust(false, 1) == doctest::Approx((12 + dt) * 0.01 / g_earth));
  }

  TEST_CASE("what thrust carries it is not learnt from a lift that nobody feels; without a sonar it sinks as ever") {
    Altitude a = landing_blind();
    a.in.estimate.lift = 5;
    a.run(10);
    CHECK(a.state.trim == 1);
    a.in.estimate.altitude_known = false;
    a.in.estimate.climb = -0.25;
    CHECK(a.run() == doctest::Approx(a.state.mean_trim - 0.03 - 0.005 * dt));
  }
}
