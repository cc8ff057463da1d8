// What the helicopter's filter learns of where it stands: its zero, and its place.
#include <doctest/doctest.h>

#include "tests/tasks/heard_helicopter.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using jarol::tests::HeardHelicopter;
using jarol::tests::hovering;

}  // namespace

TEST_SUITE("tasks/javiator_filter/rest") {
  TEST_CASE("before the first flight a tenth of what is measured is taken for zero, after it for the place") {
    HeardHelicopter heard;
    heard.run(100);
    heard.sensors.sonar += 0.01;
    heard.sensors.a_z += 0.5;
    heard.run(1);
    CHECK(heard.state.zero_z == doctest::Approx(0.055 + 0.145 + 0.001));
    CHECK(heard.state.z.bias == doctest::Approx(-0.02 * 0.5));
    CHECK(heard.out.estimate.altitude == 0);
    HeardHelicopter landed = hovering();
    landed.directive.state = FlightState::ground;
    landed.sensors.sonar = 0.145;
    const double before = landed.state.z.place;
    CHECK(landed.run(1).altitude == doctest::Approx(0.9 * before).scale(0).epsilon(1e-4));
  }

  TEST_CASE("where it stands a reading counts if the one before was the same within 8 cm, or 30 cm for a laser") {
    HeardHelicopter wrong_at_first;
    wrong_at_first.sensors.sonar = 2;
    wrong_at_first.run(1);
    wrong_at_first.sensors.sonar = 0.145;
    wrong_at_first.run(1);
    CHECK(wrong_at_first.state.zero_z == doctest::Approx(0.055 + 2).scale(0));
    wrong_at_first.run(1);
    CHECK(wrong_at_first.state.zero_z == doctest::Approx(0.055 + 0.145).scale(0));

    // one that is wrong alone, and the one after it
    const auto moved = [](double JaviatorSensors::*range, double off, double JaviatorFilter::State::*zero) {
      HeardHelicopter heard;
      heard.run(100);
      const double before = heard.state.*zero;
      heard.sensors.*range += off;
      heard.run(1);
      heard.sensors.*range -= off;
      heard.run(1);
      return heard.state.*zero - before;
    };
    for (const double side : {-1.0, 1.0}) {
      CHECK(moved(&JaviatorSensors::sonar, side * 0.0801, &JaviatorFilter::State::zero_z) == 0);
      CHECK(moved(&JaviatorSensors::sonar, side * 0.0799, &JaviatorFilter::State::zero_z) ==
            doctest::Approx(side * 0.09 * 0.0799).scale(0));
      CHECK(moved(&JaviatorSensors::laser_x, side * 0.301, &JaviatorFilter::State::zero_x) == 0);
      CHECK(moved(&JaviatorSensors::laser_y, side * 0.301, &JaviatorFilter::State::zero_y) == 0);
      CHECK(moved(&JaviatorSensors::laser_x, side * 0.299, &JaviatorFilter::State::zero_x) ==
            doctest::Approx(-side * 0.09 * 0.299).scale(0));
    }
    HeardHelicopter landed = hovering();
    landed.directive.state = FlightState::ground;
    landed.sensors.sonar = 0.145;
    const double before = landed.run(100).altitude;
    landed.sensors.sonar = 1;
    CHECK(landed.run(1).altitude == before);
    // it was lifted onto something: that lasts
    CHECK(landed.run(100).altitude == doctest::Approx(0.855).scale(0).epsilon(1e-4));
  }
}
