// What the helicopter's filter makes of the pressure: each gain and limit, at its edge.
#include <doctest/doctest.h>

#include <utility>

#include "tests/tasks/heard_helicopter.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using jarol::tests::HeardHelicopter;
using jarol::tests::hovering;

}  // namespace

TEST_SUITE("tasks/javiator_filter/pressure") {
  TEST_CASE("a pressure that jumps by more than 15 Pa from one reading to the next is lost, to either side") {
    for (const double side : {-1.0, 1.0}) {
      HeardHelicopter heard = hovering();
      heard.sensors.pressure += 14.9 * side;
      CHECK(heard.run(1).pressure_known);
      heard.sensors.pressure -= 15.1 * side;
      CHECK_FALSE(heard.run(1).pressure_known);
    }
  }

  TEST_CASE(
      "a pressure that was noisy on the ground may jump by six times as much as there, but by no more than 60 Pa") {
    for (const std::pair<double, double>& noise : {std::pair{2.0, 15.0}, {7.0, 42.0}, {20.0, 60.0}}) {
      const double step = noise.first, max = noise.second;
      CAPTURE(step);
      HeardHelicopter noisy;
      for (int i = 0; i < 300; ++i) {
        noisy.sensors.pressure += i % 2 == 0 ? step : -step;
        noisy.run(3);  // what repeats is no other reading
      }
      noisy.directive.state = FlightState::flying;
      noisy.run(1);
      for (const double part : {0.99, 1.01}) {
        HeardHelicopter heard = noisy;
        heard.sensors.pressure += part * max;
        CHECK(heard.run(1).pressure_known == (part < 1));
      }
    }
  }

  TEST_CASE("one gust on the ground is no noise, and what is no noise any more is forgotten after 200 readings") {
    const auto credible = [](HeardHelicopter heard, double step) {
      heard.directive.state = FlightState::flying;
      heard.run(1);
      heard.sensors.pressure += step;
      return heard.run(1).pressure_known;
    };
    HeardHelicopter heard;
    const auto hear = [&](double step, int readings) {
      for (int i = 0; i < readings; ++i) {
        heard.sensors.pressure += i % 2 == 0 ? step : -step;
        heard.run(1);
      }
    };
    hear(0.1, 300);
    hear(1000, 2);
    hear(0.1, 50);  // until its zero is right again
    CHECK(credible(heard, 14.9));
    CHECK_FALSE(credible(heard, 15.1));
    hear(7, 1000);
    CHECK(credible(heard, 41));
    hear(0.1, 200);  // a part of 1/e is left of it: 42 / sqrt(e) = 25.5
    CHECK(credible(heard, 25));
    CHECK_FALSE(credible(heard, 26));
  }

  TEST_CASE(
      "a sonar whose climb was not felt is lost where pressure differs by more than 60 cm, averaged over twenty "
      "readings") {
    for (const double side : {-1.0, 1.0}) {
      HeardHelicopter heard = hovering();
      heard.param.drift.climb = 0;
      heard.sensors.pressure -= 12 * side;  // a metre: 1 - 0.95^n is 0.582 after 17 readings, 0.603 after 18
      CHECK(heard.run(17).altitude_known);
      CHECK_FALSE(heard.run(1).altitude_known);
      HeardHelicopter less = hovering();
      less.sensors.pressure -= 0.59 * 12 * side;
      CHECK(less.run(1000).altitude_known);
      HeardHelicopter more = hovering();
      more.param.drift.climb = 0;
      more.sensors.pressure -= 0.61 * 12 * side;
      CHECK_FALSE(more.run(1000).altitude_known);
    }
  }

  TEST_CASE("without a sonar 5 % of what pressure differs by are taken as place, 2 % a second as speed") {
    HeardHelicopter heard = hovering();
    heard.state.sonar.lost = true;
    const AxisObserver before = heard.state.z;
    heard.sensors.pressure -= 1.2;  // ten centimetres
    heard.run(1);
    const double residual = 1.1 - before.place - before.speed * HeardHelicopter::dt;
    CHECK(heard.state.z.place - before.place == doctest::Approx(0.05 * residual).scale(0).epsilon(1e-3));
    CHECK(heard.state.z.speed - before.speed == doctest::Approx(0.02 * residual).scale(0).epsilon(1e-3));
  }
}
