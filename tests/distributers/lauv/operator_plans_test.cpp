// Maneuvers that a console starts and stops, and its abort.
#include <doctest/doctest.h>

#include "distributers/messages/payload.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;
}  // namespace

TEST_SUITE("distributers/lauv_operator_plans") {
  TEST_CASE("a plan of teleoperation is started and stopped; others are refused in words") {
    Conversation c;
    imc::PlanControl request;
    request.op = imc::PlanControl::Op::START;
    request.request_id = 7;
    request.plan_id = "by hand";
    REQUIRE(messages::put_inline(messages::refer_to(imc::Teleoperation{}), request.arg));
    c.say(request);
    c.pass(50ms);
    auto reply = c.to.last<imc::PlanControl>();
    CHECK(reply.type == imc::PlanControl::Type::SUCCESS);
    CHECK(reply.op == imc::PlanControl::Op::START);
    CHECK(reply.request_id == 7);
    CHECK(reply.plan_id == "by hand");
    CHECK(c.op_mode() == OpMode::MANEUVER);
    request.op = imc::PlanControl::Op::STOP;
    c.say(request);
    c.pass(50ms);
    CHECK(c.to.last<imc::PlanControl>().type == imc::PlanControl::Type::SUCCESS);
    CHECK(c.op_mode() == OpMode::SERVICE);
    request.op = imc::PlanControl::Op::START;
    REQUIRE(messages::put_inline(messages::refer_to(imc::DesiredZ{}), request.arg));
    c.say(request);
    c.pass(50ms);
    reply = c.to.last<imc::PlanControl>();
    CHECK(reply.type == imc::PlanControl::Type::FAILURE);
    CHECK(reply.info == "DesiredZ is not flown here");
    CHECK(c.op_mode() == OpMode::SERVICE);
  }

  TEST_CASE("a vehicle command executes and stops the same maneuver") {
    Conversation c;
    imc::VehicleCommand request;
    request.request_id = 9;
    REQUIRE(messages::put_inline(messages::refer_to(imc::Teleoperation{}), request.maneuver));
    c.say(request);
    c.pass(50ms);
    CHECK(c.to.last<imc::VehicleCommand>().type == imc::VehicleCommand::Type::SUCCESS);
    CHECK(c.to.last<imc::VehicleCommand>().request_id == 9);
    CHECK(c.op_mode() == OpMode::MANEUVER);
    request.command = imc::VehicleCommand::Command::STOP_MANEUVER;
    c.say(request);
    c.pass(50ms);
    CHECK(c.op_mode() == OpMode::SERVICE);
    request.command = imc::VehicleCommand::Command::START_CALIBRATION;
    c.say(request);
    c.pass(50ms);
    CHECK(c.to.last<imc::VehicleCommand>().type == imc::VehicleCommand::Type::FAILURE);
    CHECK(c.to.last<imc::VehicleCommand>().info == "there is nothing to calibrate");
  }

  TEST_CASE("an abort stops the propeller and commands the surface; the state is an error for a second, then service") {
    Conversation c;
    c.report({.heading = 0.5});
    c.say(imc::DesiredZ{3, imc::ZUnits::DEPTH});
    c.say(imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS});
    c.pass(50ms);
    c.say(imc::Abort{});
    check(c.setpoint(), {0, 0.5, 0});
    c.pass(50ms);
    const auto state = c.to.last<imc::VehicleState>();
    CHECK(state.op_mode == OpMode::ERROR);
    CHECK(state.error_count == 1);
    CHECK(state.error_ents == "Operator");
    CHECK(state.last_error == "abort");
    c.say(imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS});
    check(c.setpoint(), {0, 0.5, 0});
    c.pass(900ms);
    CHECK(c.op_mode() == OpMode::ERROR);
    c.pass(50ms);
    CHECK(c.op_mode() == OpMode::SERVICE);
    CHECK(c.to.last<imc::VehicleState>().error_count == 0);
    CHECK(c.to.last<imc::VehicleState>().last_error == "abort");
    c.say(imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS});
    check(c.setpoint(), {0, 0.5, 1.2});
  }

  TEST_CASE("an alarm of the vehicle is an error until the vehicle has none; stops and aborts ask it to forget") {
    Conversation c;
    c.report({.alarm = tasks::Alarm::leak});
    c.pass(2s);
    CHECK(c.op_mode() == OpMode::ERROR);
    CHECK(c.contact().stops == 0);
    imc::PlanControl plan;
    plan.op = imc::PlanControl::Op::STOP;
    c.say(plan);
    CHECK(c.contact().stops == 1);
    imc::VehicleCommand maneuver;
    maneuver.command = imc::VehicleCommand::Command::STOP_MANEUVER;
    c.say(maneuver);
    CHECK(c.contact().stops == 2);
    c.say(imc::Abort{});
    CHECK(c.contact().stops == 3);
    check(c.setpoint(), {0, 0, 0});
    c.pass(2s);
    CHECK(c.op_mode() == OpMode::ERROR);  // the vehicle has not forgotten it
    c.report({.alarm = tasks::Alarm::none});
    c.pass(50ms);
    CHECK(c.op_mode() == OpMode::SERVICE);
    CHECK(c.to.last<imc::PlanControlState>().state == imc::PlanControlState::State::READY);
    c.act("Exit=1");  // lets go of the stick, and no more
    CHECK(c.contact().stops == 3);
  }
}
