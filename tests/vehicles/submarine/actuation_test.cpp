// Power and actuators of the submarine by hand computations, one step at a time.
#include "vehicles/submarine/actuation.h"

#include <doctest/doctest.h>

#include <cmath>

#include "graph/text/errors.h"
#include "vehicles/submarine/power.h"

namespace {
using namespace jarol::vehicles;
using jarol::degree;
}  // namespace

TEST_SUITE("vehicles/submarine_actuation") {
  TEST_CASE("fins turn by 333.3 degrees a second up to 45, and over a step the water sees them halfway") {
    SubmarineActuation actuation({});
    actuation.command_servo(1, 2);
    SubmarineInput seen = actuation.step();
    CHECK(actuation.servos()[1] == doctest::Approx(3.333 * degree));
    CHECK(seen.fins[1] == doctest::Approx(3.333 / 2 * degree));
    CHECK(seen.fins[0] == 0);
    for (int i = 2; i <= 13; ++i) seen = actuation.step();
    CHECK(actuation.servos()[1] == doctest::Approx(13 * 3.333 * degree));
    CHECK(seen.fins[1] == doctest::Approx(12.5 * 3.333 * degree));
    seen = actuation.step();
    CHECK(actuation.servos()[1] == doctest::Approx(45 * degree));
    CHECK(seen.fins[1] == doctest::Approx((13 * 3.333 + 45) / 2 * degree));
  }

  TEST_CASE("DUNE's simulator sees fins where they were at the start of a step") {
    SubmarineParameters parameters;
    parameters.vsim_compatible = true;
    SubmarineActuation actuation(parameters);
    actuation.command_servo(3, -2);
    CHECK(actuation.step().fins[3] == 0);
    CHECK(actuation.servos()[3] == doctest::Approx(-3.333 * degree));
    CHECK(actuation.step().fins[3] == doctest::Approx(-3.333 * degree));
  }

  TEST_CASE("the propeller follows with a lag of 50 ms, and over a step the water sees it halfway") {
    SubmarineActuation actuation({});
    actuation.command_thruster(0.5);
    const double once = 0.5 * 261.8 * (1 - std::exp(-0.2)), twice = 0.5 * 261.8 * (1 - std::exp(-0.4));
    CHECK(actuation.step().propeller == doctest::Approx(once / 2));
    CHECK(actuation.propeller() == doctest::Approx(once));
    CHECK(actuation.step().propeller == doctest::Approx((once + twice) / 2));
    actuation.command_thruster(-3);
    for (int i = 0; i < 200; ++i) {
      actuation.command_thruster(-3);
      actuation.step();
    }
    CHECK(actuation.propeller() == doctest::Approx(-261.8));
  }

  TEST_CASE("the propeller draws by the cube of its speed, either way, beside what everything else draws") {
    Power power({});
    power.draw(0, 0.01);
    CHECK(power.current() == 1);
    power.draw(0.5, 0.01);
    CHECK(power.current() == doctest::Approx(1 + 6 * 0.125));
    power.draw(-1, 0.01);
    CHECK(power.current() == doctest::Approx(7));
  }

  TEST_CASE("the battery's voltage falls with the charge used, and by its resistance") {
    Power power({});
    power.draw(1, 3600);  // 7 A h of 20
    CHECK(power.voltage() == doctest::Approx(25.2 - 7.2 * 7 / 20 - 0.1 * 7));
    power.draw(0, 1800);
    CHECK(power.voltage() == doctest::Approx(25.2 - 7.2 * 7.5 / 20 - 0.1));
  }

  TEST_CASE("a battery may begin with a part of its charge, and disconnects itself when all is used, not before") {
    PowerParameters parameters;
    parameters.charge = 0.05;  // 1 A h
    Power power(parameters);
    CHECK(power.voltage() == doctest::Approx(18 + 0.05 * 7.2));
    power.draw(0, 3599);
    CHECK_FALSE(power.is_flat());
    CHECK(power.voltage() == doctest::Approx(18 - 0.1).scale(0).epsilon(0.002));
    power.draw(0, 1);
    CHECK(power.is_flat());
    CHECK(power.voltage() == 0);
    power.draw(1, 1);
    CHECK(power.current() == 0);
  }

  TEST_CASE("a battery that no submarine can have is an error") {
    CHECK_THROWS_WITH_AS(Power({.empty = 30}),
                         "submarine: power.empty must not be above power.full, and is 30 V where that is 25.2 V",
                         jarol::InputError);
    CHECK_THROWS_WITH_AS(Power({.capacity = 0}), "submarine: power.capacity must be above zero", jarol::InputError);
    CHECK_THROWS_WITH_AS(Power({.resistance = -1}), "submarine: power.resistance is below zero", jarol::InputError);
    CHECK(Power({.full = 24, .empty = 24}).voltage() == 24);  // one that does not sag
  }

  TEST_CASE("without power the propeller runs down whatever is commanded, and fins stay where they are") {
    SubmarineActuation actuation({});
    actuation.command_thruster(0.5);
    actuation.command_servo(1, 0.2);
    for (int i = 0; i < 100; ++i) actuation.step();
    actuation.command_servo(1, -0.2);
    for (int i = 0; i < 100; ++i) {
      actuation.command_thruster(1);
      actuation.step(false);
    }
    CHECK(actuation.propeller() < 1e-6);
    CHECK(actuation.servos()[1] == doctest::Approx(0.2));
    CHECK(actuation.step(false).fins[1] == doctest::Approx(0.2));
    for (int i = 0; i < 50; ++i) actuation.step();
    CHECK(actuation.propeller() > 261);
    CHECK(actuation.servos()[1] == doctest::Approx(-0.2));
  }

  TEST_CASE(
      "a fin that is stuck stays where it is, one that is lost or weak turns and gives none or a part of its lift") {
    SubmarineParameters parameters;
    const auto kind = [](ActuatorFailureKind how) { return ActuatorFailure{.kind = how, .at = 0.5, .by = 0.3}; };
    parameters.failures.fin0 = kind(ActuatorFailureKind::stuck);
    parameters.failures.fin1 = kind(ActuatorFailureKind::lost);
    parameters.failures.fin2 = kind(ActuatorFailureKind::weak);
    SubmarineActuation actuation(parameters);
    const auto turn = [&](double angle, int steps) {
      for (std::size_t i = 0; i < 4; ++i) actuation.command_servo(i, angle);
      SubmarineInput seen;
      for (int i = 0; i < steps; ++i) seen = actuation.step();
      return seen.fins;
    };
    for (const double angle : turn(0.2, 50)) CHECK(angle == doctest::Approx(0.2));
    const auto fins = turn(-0.1, 50);
    CHECK(fins[0] == doctest::Approx(0.2));
    CHECK(fins[1] == 0);
    CHECK(fins[2] == doctest::Approx(-0.03));
    CHECK(fins[3] == doctest::Approx(-0.1));
    CHECK(actuation.servos()[0] == doctest::Approx(0.2));
    CHECK(actuation.servos()[1] == doctest::Approx(-0.1));
    CHECK(actuation.servos()[2] == doctest::Approx(-0.1));
  }

  TEST_CASE("a fin that goes hard over ends at its limit or at a part of it, to either side, whatever is commanded") {
    SubmarineParameters parameters;
    const auto over = [](double to) {
      return ActuatorFailure{.kind = ActuatorFailureKind::hardover, .at = 0.5, .to = to};
    };
    parameters.failures.fin0 = over(1);
    parameters.failures.fin1 = over(-1);
    parameters.failures.fin2 = over(0.5);
    SubmarineActuation actuation(parameters);
    for (std::size_t i = 0; i < 4; ++i) actuation.command_servo(i, 0.1);
    for (int i = 0; i < 50; ++i) actuation.step();
    for (const double angle : actuation.servos()) CHECK(angle == doctest::Approx(0.1));
    actuation.step();
    CHECK(actuation.servos()[0] == doctest::Approx(0.1 + 0.01 * parameters.servos.slew));  // no faster than it can
    SubmarineInput seen;
    for (int i = 0; i < 50; ++i) seen = actuation.step();
    const double limit = parameters.servos.limit;
    CHECK(seen.fins[0] == doctest::Approx(limit));
    CHECK(seen.fins[1] == doctest::Approx(-limit));
    CHECK(seen.fins[2] == doctest::Approx(limit / 2));
    CHECK(seen.fins[3] == doctest::Approx(0.1));
  }

  TEST_CASE(
      "a propeller that is lost runs down, one that is stuck turns on while there is power, a weak one gives a part of "
      "its thrust") {
    const auto speed = [](ActuatorFailureKind how, bool powered) {
      SubmarineParameters parameters;
      parameters.failures.propeller = {.kind = how, .at = 1, .by = 0.25};
      SubmarineActuation actuation(parameters);
      actuation.command_thruster(0.8);
      for (int i = 0; i < 100; ++i) actuation.step();
      actuation.command_thruster(0.4);
      for (int i = 0; i < 100; ++i) actuation.step(powered);
      return actuation.propeller() / parameters.thruster.full_speed;
    };
    CHECK(speed(ActuatorFailureKind::none, true) == doctest::Approx(0.4));
    CHECK(speed(ActuatorFailureKind::lost, true) < 1e-6);
    CHECK(speed(ActuatorFailureKind::stuck, true) == doctest::Approx(0.8));
    CHECK(speed(ActuatorFailureKind::stuck, false) < 1e-6);
    CHECK(speed(ActuatorFailureKind::weak, true) == doctest::Approx(0.2));
    CHECK(speed(ActuatorFailureKind::hardover, true) == doctest::Approx(1));
    CHECK(speed(ActuatorFailureKind::hardover, false) < 1e-6);
  }

  TEST_CASE("a failure of an actuator that lasts a second ends after it, and it follows again") {
    FailingActuator fin({.kind = ActuatorFailureKind::hardover, .at = 2, .to = -1, .lasts = 1}, 0);
    CHECK(fin.command(1.99, 0.1, 0.5) == 0.1);
    CHECK(fin.command(2, 0.1, 0.5) == -0.5);
    CHECK(fin.command(2.99, 0.1, 0.5) == -0.5);
    CHECK(fin.command(3, 0.1, 0.5) == 0.1);
    FailingActuator motor({.kind = ActuatorFailureKind::lost, .at = 2, .lasts = 1}, 0);
    CHECK(motor.part(2.99) == 0);
    CHECK(motor.part(3) == 1);
    FailingActuator stuck({.kind = ActuatorFailureKind::stuck, .at = 2}, 0);
    CHECK(stuck.is_stuck(1e8));
  }

  TEST_CASE("an actuator fails by chance from its time on, another with each seed") {
    const auto stuck_at = [](std::uint64_t seed) {
      SubmarineParameters parameters;
      parameters.failures.fin1 = {.kind = ActuatorFailureKind::stuck, .at = 1, .chance = 0.5};
      SubmarineActuation actuation(parameters, seed);
      for (int i = 0; i < 3000; ++i) {
        const double before = actuation.servos()[1];
        actuation.command_servo(1, i % 2 == 0 ? 0.05 : -0.05);
        actuation.step();
        if (actuation.servos()[1] == before) return i;
      }
      return 3000;
    };
    CHECK(stuck_at(1) >= 100);
    CHECK(stuck_at(1) < 3000);
    CHECK(stuck_at(1) == stuck_at(1));
    CHECK(stuck_at(1) != stuck_at(2));
  }

  TEST_CASE("the hull warms by 3 K for each ampere, after ten minutes to two thirds") {
    Power power({});
    power.draw(1, 600);
    CHECK(power.warmth() == doctest::Approx(21 * (1 - std::exp(-1))));
    power.draw(0, 1e9);
    CHECK(power.warmth() == doctest::Approx(3));
  }
}
