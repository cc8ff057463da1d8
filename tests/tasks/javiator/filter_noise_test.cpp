// How the helicopter's filter follows a sonar that is noisier than usual, and whether the pressure confirms it.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/tasks/heard_helicopter.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using jarol::tests::HeardHelicopter;
using jarol::tests::hovering;

constexpr double dt = HeardHelicopter::dt;

// The part of a step of 1 cm that the altitude takes at once, after residuals of that RMS (m) up to now.
double taken_after(HeardHelicopter heard, double rms) {
  heard.state.z = {.place = heard.state.z.place, .residual_squared = rms * rms};
  const double before = heard.state.z.place;
  heard.sensors.sonar += 0.01;
  heard.run(1);
  return (heard.state.z.place - before) / 0.01;
}

doctest::Approx part_at(double bandwidth) {
  return doctest::Approx(1 - std::exp(-3 * bandwidth * dt)).scale(0).epsilon(0.02);
}

}  // namespace

TEST_SUITE("tasks/javiator_filter/noise") {
  TEST_CASE("a sonar is followed at 6 rad/s up to residuals of 12 mm, and at as much less as they are greater") {
    const HeardHelicopter heard = hovering();
    CHECK(taken_after(heard, 0) == part_at(6));
    CHECK(taken_after(heard, 0.0120) == part_at(6));
    // of 3 cm, and with the new one of 1 cm: sqrt(0.95 9 + 0.05 1) = 2.93 cm
    CHECK(taken_after(heard, 0.03) == part_at(6 * 1.2 / 2.93));
    CHECK(taken_after(heard, 0.06) == part_at(6 * 1.2 / 5.85));
  }

  TEST_CASE("of each new residual 5 % go into that mean, and where it stands it is forgotten") {
    HeardHelicopter heard = hovering();
    heard.state.z = {.place = heard.state.z.place};
    heard.sensors.sonar += 0.02;
    heard.run(1);
    CHECK(heard.state.z.residual_squared == doctest::Approx(0.05 * 0.02 * 0.02).scale(0).epsilon(1e-3));
    heard.directive.state = FlightState::ground;
    heard.run(1);
    CHECK(heard.state.z.residual_squared == 0);
  }

  TEST_CASE("without its IMU it follows the sonar as quickly however noisy that is") {
    for (const bool known : {false, true}) {
      HeardHelicopter heard = hovering();
      heard.sensors.new_imu = false;
      heard.blind = {.lift = 9.81, .known = known};
      heard.run(20);
      CHECK(taken_after(heard, 0.03) == part_at(known ? 20 : 6));
    }
  }

  TEST_CASE("the pressure confirms an altitude from which its own differs by less than 25 cm, either way") {
    for (const double side : {-1.0, 1.0}) {
      HeardHelicopter heard = hovering();
      CHECK(heard.out.estimate.altitude_confirmed);
      heard.sensors.pressure -= 0.24 * 12 * side;
      CHECK(heard.run(300).altitude_confirmed);
      heard.sensors.pressure -= 0.02 * 12 * side;
      CHECK_FALSE(heard.run(300).altitude_confirmed);
      CHECK(heard.out.estimate.altitude_known);
      CHECK(heard.out.estimate.pressure_known);
    }
  }

  TEST_CASE("nothing confirms an altitude without the sonar, or without the pressure") {
    for (SensorTrust JaviatorFilter::State::*const sensor :
         {&JaviatorFilter::State::sonar, &JaviatorFilter::State::pressure}) {
      HeardHelicopter heard = hovering();
      (heard.state.*sensor).lost = true;
      CHECK_FALSE(heard.run(1).altitude_confirmed);
    }
  }
}
