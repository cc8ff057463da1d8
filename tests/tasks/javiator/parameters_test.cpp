// What the helicopter's filter and observers make of parameters that others than the vehicles of specs/ have.
#include <doctest/doctest.h>

#include <cmath>

#include "tasks/javiator/blind_observer.h"
#include "tasks/javiator/control.h"
#include "tests/tasks/heard_helicopter.h"
#include "tests/tasks/javiator/driven_logic.h"
#include "tests/tasks/javiator/every_15_ms.h"
#include "tests/tasks/javiator/watched.h"

namespace {
using namespace jarol::tasks;
using Eigen::Vector3d;
using jarol::tests::g_earth;
using jarol::tests::HeardHelicopter;
using jarol::tests::Logic;
using jarol::tests::tick;
using jarol::tests::Watched;

// By a laser in the middle that looks so far from north.
WallFix seen(const WallSight& sight, double angle, const Eigen::Vector2d& expected = {0, 0}) {
  return find_place({.north = 8, .east = 8, .sight = sight}, {0, 0, 0}, {std::cos(angle), std::sin(angle), 0}, 8,
                    expected);
}
}  // namespace

TEST_SUITE("tasks/javiator/parameters") {
  TEST_CASE("which wall a laser meets is sure by the distance that is given, and a place seen up to an angle") {
    // the walls are 8 / cos and 8 / sin away: 9.1 and 16.7 m
    CHECK_FALSE(seen({}, 0.5).at_corner);
    CHECK(seen({.corner = 8}, 0.5).at_corner);
    // 20 cm more to each of them for a place that may be off by more
    CHECK_FALSE(seen({.corner = 7.2}, 0.5).at_corner);
    CHECK(seen({.corner = 7.2, .place_error = 0.2}, 0.5).at_corner);
    // 60 cm from the eastern wall, which the laser grazes
    const Eigen::Vector2d beside(-10, 7.4);
    CHECK(seen({}, 0.15, beside).seen);
    CHECK_FALSE(seen({.grazing = 0.2}, 0.15, beside).seen);
  }

  TEST_CASE("a wall is met from a place expected behind it, by as much as that may be off") {
    CHECK(seen({.place_error = 0.2}, 0, {8.15, 0}).seen);
    CHECK_FALSE(seen({.place_error = 0.2}, 0, {8.25, 0}).seen);
    CHECK_FALSE(seen({}, 0, {8.15, 0}).seen);
  }

  TEST_CASE("where it stands the filter learns by the parts that are given") {
    HeardHelicopter heard;
    heard.param.drift.rest = {.bias_part = 0.5, .place_part = 0.25, .pressure_part = 0.75};
    heard.run(100);
    heard.sensors.a_x = 0.02;
    heard.sensors.a_y = 0.04;
    heard.sensors.a_z += 0.5;
    heard.sensors.p = 0.01;
    heard.sensors.q = 0.02;
    heard.sensors.sonar += 0.01;
    heard.sensors.pressure += 4;
    heard.run(1);
    CHECK(heard.state.x.bias == doctest::Approx(0.01).scale(0).epsilon(1e-6));
    CHECK(heard.state.y.bias == doctest::Approx(0.02).scale(0).epsilon(1e-6));
    CHECK(heard.state.z.bias == doctest::Approx(-0.25));
    CHECK(heard.state.slow_roll.bias == doctest::Approx(0.005));
    CHECK(heard.state.slow_pitch.bias == doctest::Approx(0.01).scale(0).epsilon(1e-6));
    CHECK(heard.state.zero_z == doctest::Approx(0.055 + 0.145 + 0.0025));
    CHECK(heard.state.ground.mean == doctest::Approx(101325 + 3));
  }

  TEST_CASE("where it has landed the filter learns its place by the part that is given") {
    HeardHelicopter heard;
    heard.param.drift.rest.place_part = 0.25;
    heard.run(100);
    heard.directive.state = FlightState::flying;
    heard.run(1);
    heard.directive.state = FlightState::ground;
    heard.sensors.laser_x -= 0.04;
    heard.sensors.laser_y -= 0.08;
    heard.sensors.sonar += 0.06;
    heard.run(1);
    CHECK(heard.state.x.place == doctest::Approx(0.01).scale(0).epsilon(1e-6));
    CHECK(heard.state.y.place == doctest::Approx(0.02).scale(0).epsilon(1e-6));
    CHECK(heard.state.z.place == doctest::Approx(0.015).scale(0).epsilon(1e-6));
  }

  TEST_CASE("the voltage is averaged over the time that is given") {
    HeardHelicopter heard = jarol::tests::hovering();
    heard.param.age.battery_time = 2;
    heard.sensors.battery = 14;
    CHECK(heard.run(1).battery == doctest::Approx(15 - HeardHelicopter::dt / 2));
  }

  TEST_CASE("a battery is made up for by as much signal as is given, more and less") {
    const auto signal_at = [](double battery) {
      const MotorMixer::Param p{.quick_lag = 0.05, .battery = {.min = 0.5, .max = 2}};
      MotorMixer::State state;
      MotorMixer::Out out;
      MotorMixer::run(p, tick,
                      {.lift = {1}, .directive = {.state = FlightState::flying}, .estimate = {.battery = battery}},
                      state, out);
      return out.motors.signals[0];
    };
    CHECK(signal_at(15.887 / 0.6) == doctest::Approx(8000 * 0.6));
    CHECK(signal_at(15.887 / 0.4) == doctest::Approx(8000 * 0.5));
    CHECK(signal_at(15.887 / 1.9) == doctest::Approx(8000 * 1.9));
    CHECK(signal_at(15.887 / 2.1) == doctest::Approx(8000 * 2));
  }

  TEST_CASE("where it lands is where it comes to rest in its time, and a lean is stored up to its limit") {
    Logic logic;
    logic.param.way.stop_time = 2;
    logic.param.max_trim = 0.03;
    logic.fly();
    logic.in.estimate.v_x = 0.2;
    logic.in.estimate.v_y = -0.1;
    logic.in.estimate.roll = 0.05;
    ++logic.in.command.trim_stores;
    logic.press();
    CHECK(logic.out.directive.state == FlightState::landing);
    CHECK(logic.out.directive.x == doctest::Approx(0.4));
    CHECK(logic.out.directive.y == doctest::Approx(-0.2));
    CHECK(logic.out.directive.trim_roll == 0.03);
  }

  TEST_CASE("a motor is weak the later, the less one sample may add, and gives no less than is given") {
    const auto periods = [](double of_one_sample) {
      Watched w;
      w.param.of_one_sample = of_one_sample;
      w.body.parts[0] = 0.3;
      int needed = 0;
      for (; w.out.motors.weak == Motor::none && needed < 100; ++needed) w.run(1);
      return needed;
    };
    CHECK(periods(0.9) < periods(0.2));
    Watched dead;
    dead.param.min_effectiveness = 0.25;
    dead.body.parts[0] = 0;
    dead.run(60);
    CHECK(dead.out.motors.weak == Motor::front);
    CHECK(dead.out.motors.effectiveness[0] == 0.25);
  }

  TEST_CASE("what the rotors are taken to give follows the voltage as far as is given, to either side") {
    const auto thrust_at = [](double battery) {
      Watched w;
      w.param.battery = {.min = 0.5, .max = 2};
      w.in.estimate.battery = battery;
      w.run(1);
      return w.state.rotors[0].now[0];
    };
    CHECK(thrust_at(15.887 / 0.6) == doctest::Approx(std::pow(1 / 0.6, 1.415)));
    CHECK(thrust_at(15.887 / 0.4) == doctest::Approx(std::pow(1 / 0.5, 1.415)));
    CHECK(thrust_at(15.887 / 1.9) == doctest::Approx(std::pow(1 / 1.9, 1.415)));
    CHECK(thrust_at(15.887 / 2.1) == doctest::Approx(std::pow(1 / 2.0, 1.415)));
  }

  TEST_CASE("a motor that is found weak lacks a part of its thrust, or of the least that is given") {
    const auto gives = [](double min_thrust) {
      Watched w;
      w.param.min_thrust = min_thrust;
      const double low = 8000 * std::pow(0.5, 1 / 1.415);
      for (int i = 0; i < 60; ++i) w.period({low, low, low, low});
      w.body.parts[0] = 0.25;
      for (int i = 0; i < 60 && w.out.motors.weak == Motor::none; ++i) w.period({low, low, low, low});
      CHECK(w.out.motors.weak == Motor::front);
      return w.out.motors.effectiveness[0];
    };
    // of half of hover's thrust it lacks three quarters, of which two samples show nearly all
    const double lacks = 1 - gives(0.1);
    CHECK(std::abs(lacks - 0.75) < 0.03);
    CHECK(1 - gives(0.8) == doctest::Approx(lacks * 0.5 / 0.8));
  }

  TEST_CASE("the noise of the pressure is that of as many steps as are given, each up to the greatest") {
    GroundPressure ground;
    const RestLearning by{.steps = 3, .max_step = 2};
    double last = 0;
    for (const double pressure : {100.0, 101.0, 101.0, 101.0}) {
      learn(ground, pressure, last, by);
      last = pressure;
    }
    CHECK(ground.readings == 3);
    CHECK(ground.step_squared == doctest::Approx(0.25));  // 1, halved twice
    learn(ground, 151, 101, by);
    CHECK(ground.step_squared == doctest::Approx(0.125 + 0.5 * 2 * 2));
  }

  TEST_CASE("when the IMU is lost guesses begin as well known as is given, with winds so far apart") {
    BlindObserver::Param p;
    p.gusts = 2;
    p.start = {.place = 0.1, .speed = 0.2, .lean = 0.3, .rate = 0.4, .wind_apart = 0.5, .wind_width = 0.25};
    p.gust_time = 1000;
    p.force_noise = p.torque_noise = 0;
    BlindObserver::State state;
    BlindObserver::Out out;
    BlindObserver::In in{.estimate = {.altitude = 100, .lift = g_earth, .rates_known = true}, .lift = {1}};
    BlindObserver::run(p, tick, in, state, out);
    in.estimate.rates_known = false;
    BlindObserver::run(p, {.period = std::chrono::nanoseconds(0)}, in, state, out);
    for (int i = 0; i < 5; ++i) {
      const LeanGuess& guess = state.x.guesses[static_cast<std::size_t>(i)];
      CHECK(guess.wind == doctest::Approx(0.5 * 2 * (i - 2)));
      CHECK(guess.weight / state.x.guesses[2].weight == doctest::Approx(std::exp(-0.5 * std::pow(0.5 * (i - 2), 2))));
      for (const auto& [at, deviation] : {std::pair{0, 0.1}, {6, 0.2}, {12, 0.3}, {18, 0.4}, {24, 0.25 * 2}})
        CHECK(guess.covariance[static_cast<std::size_t>(at)] == doctest::Approx(deviation * deviation));
    }
  }

  TEST_CASE("rotors that were at rest count as turning by the least demand that is given") {
    const auto climbs = [](double min_thrust) {
      BlindObserver::Param p;
      p.min_thrust = min_thrust;
      BlindObserver::State state{.mean_thrust = 0, .felt_thrust = 0.4, .lift = 0};
      BlindObserver::Out out;
      BlindObserver::In in{.estimate = {.altitude = 100, .climb = 1}, .lift = {0.4}};
      state.last_thrust = 0.4;
      BlindObserver::run(p, tick, in, state, out);
      return out.motion.lift;
    };
    // the spin, a root, brakes a climb
    const double carries = climbs(0.4) + 0.83;
    CHECK(carries - climbs(0.1) == doctest::Approx(2 * 0.83));
  }
}
