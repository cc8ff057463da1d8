// References for the autopilot, as a console sends them.
#include <doctest/doctest.h>

#include <array>
#include <numbers>

#include "graph/math/geometry.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;

}  // namespace

TEST_SUITE("distributers/lauv_operator_references") {
  TEST_CASE("depth, heading and speed become one setpoint, taken once after each change") {
    Conversation c;
    tasks::Setpoint value;
    CHECK_FALSE(c.adapter.take<&LauvOperator::In::setpoint>(value));
    c.say(imc::DesiredZ{3, imc::ZUnits::DEPTH});
    c.say(imc::DesiredHeading{90 * degree});
    c.say(imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS});
    CHECK(c.adapter.take<&LauvOperator::In::setpoint>(value));
    check(value, {3, 90 * degree, 1.2});
    CHECK_FALSE(c.adapter.take<&LauvOperator::In::setpoint>(value));
    c.pass(50ms);
    const auto state = c.to.last<imc::VehicleState>();
    CHECK(state.op_mode == OpMode::EXTERNAL);
    CHECK(state.control_loops == 0x4c8);  // depth, yaw, speed, torque
  }

  TEST_CASE("a depth beyond the limit less its margin is taken as that, and who wants it gets the reason, once") {
    LauvOperatorParameters parameters;
    parameters.limits.max_depth = 20;
    parameters.limits.margin = 1;
    Conversation c(parameters);
    c.say(imc::DesiredZ{19, imc::ZUnits::DEPTH});
    c.pass(50ms);
    CHECK(c.setpoint().depth == 19);
    CHECK(c.to.all<imc::LogBookEntry>().empty());
    c.say(imc::DesiredZ{5, imc::ZUnits::DEPTH});
    for (int i = 0; i < 3; ++i) c.say(imc::DesiredZ{50, imc::ZUnits::DEPTH});
    c.pass(50ms);
    CHECK(c.setpoint().depth == 19);
    CHECK(c.to.all<imc::LogBookEntry>().size() == 1);
    CHECK(c.to.last<imc::LogBookEntry>().text == "DesiredZ is 50 m; depths are at most 19 m: it goes there");
    c.act("Thrust=0");  // to a hand that steers, too
    c.say(imc::DesiredZ{3, imc::ZUnits::DEPTH});
    c.say(imc::DesiredZ{30, imc::ZUnits::DEPTH});
    CHECK(c.setpoint().depth == 19);
  }

  TEST_CASE("a heading rate and a speed in % become rate and thrust") {
    Conversation c;
    c.say(imc::DesiredHeadingRate{0.1});
    c.say(imc::DesiredSpeed{40, imc::SpeedUnits::PERCENTAGE});
    check(c.setpoint(), by_hand(0.1, 0.4));
    c.say(imc::DesiredSpeed{400, imc::SpeedUnits::PERCENTAGE});
    check(c.setpoint(), by_hand(0.1, 1));
  }

  TEST_CASE("a first reference that is no heading keeps the present one") {
    Conversation c;
    c.report({.heading = 0.5});
    c.say(imc::DesiredZ{2, imc::ZUnits::DEPTH});
    check(c.setpoint(), {2, 0.5, 0});
  }

  TEST_CASE("a reference that can't be used is refused in words and changes nothing") {
    Conversation c;
    const auto refused = [&](const auto& message, const char* text) {
      c.say(message);
      c.pass(50ms);
      const auto entry = c.to.last<imc::LogBookEntry>();
      CHECK(entry.type == imc::LogBookEntry::Type::WARNING);
      CHECK(entry.text == text);
    };
    refused(imc::DesiredZ{3, imc::ZUnits::ALTITUDE}, "DesiredZ is taken as a depth in m only");
    refused(imc::DesiredZ{NAN, imc::ZUnits::DEPTH}, "DesiredZ is taken as a depth in m only");
    refused(imc::DesiredHeading{NAN}, "DesiredHeading is no number");
    refused(imc::DesiredHeadingRate{INFINITY}, "DesiredHeadingRate is no number");
    refused(imc::DesiredSpeed{1000, imc::SpeedUnits::RPM}, "DesiredSpeed is taken in m/s or % only");
    CHECK(c.adapter.non_finite_inputs() == 3);
    CHECK_FALSE(c.adapter.take<&LauvOperator::In::setpoint>(c.value));
    CHECK(c.op_mode() == OpMode::SERVICE);
  }

  TEST_CASE("the newest command wins: a heading takes over from the hand, the hand from the autopilot") {
    Conversation c;
    c.act("Heading=127;Thrust=127");
    c.say(imc::DesiredHeading{1});
    check(c.setpoint(), {0, 1, 0});
    c.pass(50ms);
    CHECK(c.op_mode() == OpMode::EXTERNAL);
    c.act("Heading=127;Thrust=127");
    check(c.setpoint(), by_hand(40 * degree, 0.7));
  }

  TEST_CASE("thruster and servo commands become an actuation by hand") {
    Conversation c;
    tasks::Actuation value;
    CHECK_FALSE(c.adapter.take<&LauvOperator::In::actuation>(value));
    c.say(imc::SetThrusterActuation{0, 0.5F});
    c.say(imc::SetServoPosition{2, 0.25F});
    c.say(imc::SetServoPosition{4, 1});      // there is no such fin
    c.say(imc::SetThrusterActuation{1, 1});  // nor such a thruster
    CHECK(c.adapter.take<&LauvOperator::In::actuation>(value));
    CHECK(value.thruster == 0.5);
    CHECK(value.fins == std::array<double, 4>{0, 0, 0.25, 0});
    CHECK_FALSE(c.adapter.take<&LauvOperator::In::actuation>(value));
  }
}
