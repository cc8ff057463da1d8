// Steering by hand over RemoteActions.
#include <doctest/doctest.h>

#include <numbers>

#include "graph/math/geometry.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;
using tasks::Drive;
using tasks::Turn;

}  // namespace

TEST_SUITE("distributers/lauv_operator_hand") {
  TEST_CASE("axes steer: full stick is 40 degrees a second and 70 % of the thrust") {
    Conversation c;
    c.act("Heading=127;Thrust=127");
    check(c.setpoint(), by_hand(40 * degree, 0.7));
    c.act("Heading=-63.5;Thrust=-254");
    check(c.setpoint(), by_hand(-20 * degree, -0.7));
    c.pass(50ms);
    const auto state = c.to.last<imc::VehicleState>();
    CHECK(state.op_mode == OpMode::MANEUVER);
    CHECK(state.maneuver_type == 452);
    CHECK(state.control_loops == 0x250a);  // teleoperation, depth, yaw rate, throttle, torque
    CHECK(c.to.last<imc::PlanControlState>().state == imc::PlanControlState::State::EXECUTING);
  }

  TEST_CASE("a hand that is silent for two seconds has thrust and rate 0") {
    Conversation c;
    c.act("Heading=127;Thrust=127");
    c.pass(1950ms);
    check(c.setpoint(), by_hand(40 * degree, 0.7));
    c.pass(50ms);
    check(c.setpoint(), by_hand(0, 0));
    CHECK(c.op_mode() == OpMode::MANEUVER);
    c.act("Heading=0;Thrust=127");
    check(c.setpoint(), by_hand(0, 0.7));
  }

  TEST_CASE("buttons accelerate and decelerate by 10 % a second while held, and stop") {
    Conversation c;
    c.act("Thrust=0;Accelerate=1");
    for (int i = 0; i < 30; ++i) {
      c.pass(100ms);
      c.act("Thrust=0;Accelerate=1");  // the axis rests
    }
    check(c.setpoint(), by_hand(0, 0.3));
    c.act("Decelerate=1;Accelerate=0");
    c.pass(1s);
    check(c.setpoint(), by_hand(0, 0.2));
    c.act("Decelerate=0");
    c.pass(1s);
    check(c.setpoint(), by_hand(0, 0.2));
    c.act("Stop=1");
    check(c.setpoint(), by_hand(0, 0));
  }

  TEST_CASE("actions that are garbage steer nowhere") {
    Conversation c;
    c.act("Heading=;Thrust=abc;=;Heading;;;Heading=1e999;Thrust=nan");
    check(c.setpoint(), by_hand(0, 0));
  }

  TEST_CASE("by hand the depth is held, and commanded as before") {
    Conversation c;
    c.say(imc::DesiredZ{3, imc::ZUnits::DEPTH});
    c.act("Heading=0;Thrust=127");
    CHECK(c.setpoint().depth == 3);
    c.say(imc::DesiredZ{2, imc::ZUnits::DEPTH});
    check(c.setpoint(), {2, 0, 0, Turn::rate, 0, Drive::thrust, 0.7});
  }

  TEST_CASE("exit ends the steering by hand") {
    Conversation c;
    c.act("Heading=127;Thrust=127");
    c.act("Exit=1");
    check(c.setpoint(), {0, 0, 0});
    c.pass(50ms);
    CHECK(c.op_mode() == OpMode::SERVICE);
    CHECK(c.to.all<imc::TeleoperationDone>().size() == 1);
  }

  TEST_CASE("after an abort a hand that goes on as before counts no more until it has been silent") {
    Conversation c;
    c.act("Thrust=127");
    c.say(imc::Abort{});
    for (int i = 0; i < 50; ++i) {
      c.pass(100ms);
      c.act("Thrust=127");
    }
    check(c.setpoint(), {0, 0, 0});
    CHECK(c.op_mode() == OpMode::SERVICE);
    c.pass(2s);
    c.act("Thrust=127");
    check(c.setpoint(), by_hand(0, 0.7));
  }

  TEST_CASE("astern it is driven at the surface only, and who wants it below gets the reason") {
    const char* const why =
        "astern it goes at the surface only; below 0.2 m the propeller stops, as the fins steer the other way round";
    const auto at_depth = [](Conversation& c, double depth) { c.report({.depth = depth}); };
    const auto refusals = [&](const Conversation& c) {
      std::size_t n = 0;
      for (const auto& entry : c.to.all<imc::LogBookEntry>()) n += entry.text == why ? 1 : 0;
      return n;
    };
    Conversation c;
    at_depth(c, 0.2);
    c.act("Thrust=-127");
    check(c.setpoint(), by_hand(0, -0.7));
    at_depth(c, 0.21);  // it has gone under meanwhile
    c.pass(50ms);
    c.pass(50ms);
    check(c.setpoint(), by_hand(0, 0));
    CHECK(refusals(c) == 1);
    c.act("Thrust=-100");
    check(c.setpoint(), by_hand(0, 0));
    c.act("Decelerate=1");
    for (int i = 0; i < 20; ++i) c.pass(50ms);
    check(c.setpoint(), by_hand(0, 0));
    CHECK(refusals(c) == 3);
    c.act("Decelerate=0;Thrust=127");
    check(c.setpoint(), by_hand(0, 0.7));

    c.say(imc::DesiredSpeed{-50, imc::SpeedUnits::PERCENTAGE});
    CHECK(c.setpoint().thrust == 0);
    c.pass(50ms);
    CHECK(refusals(c) == 4);
    c.say(imc::DesiredSpeed{50, imc::SpeedUnits::PERCENTAGE});
    CHECK(c.setpoint().thrust == 0.5);
    at_depth(c, 0.1);
    c.say(imc::DesiredSpeed{-50, imc::SpeedUnits::PERCENTAGE});
    CHECK(c.setpoint().thrust == -0.5);
    c.say(imc::DesiredSpeed{1, imc::SpeedUnits::METERS_PS});
    at_depth(c, 3);
    c.pass(50ms);
    CHECK(refusals(c) == 4);
  }
}
