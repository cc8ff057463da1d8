// Maneuvers that a console starts and stops, and its abort.
// In one file: all cases speak with one vehicle.
#include <doctest/doctest.h>

#include "distributers/messages/payload.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;

// One maneuver: go down at the origin, or north of it.
imc::PlanSpecification dive_plan(const char* name, float depth, double latitude = LauvOperatorParameters{}.latitude) {
  imc::Goto there;
  there.lat = latitude;
  there.lon = LauvOperatorParameters{}.longitude;
  there.z = depth;
  there.z_units = imc::ZUnits::DEPTH;
  there.speed = 1;
  imc::PlanManeuver named;
  named.maneuver_id = "dive";
  named.data = packed(there);
  imc::PlanSpecification plan;
  plan.plan_id = name;
  plan.start_man_id = "dive";
  plan.maneuvers.push_back(packed(named));
  return plan;
}

// An operator who stores, loads and starts plans; each returns why not, or nothing.
struct Planner : Conversation {
  template <class M>
  std::string ask(const M& request) {
    say(request);
    pass(50ms);
    return std::string(to.last<M>().info.view());
  }
  std::string store(const char* name, const imc::PlanSpecification& plan) {
    imc::PlanDB request;
    request.op = imc::PlanDB::Op::SET;
    request.plan_id = name;
    request.arg = packed(plan);
    return ask(request);
  }
  std::string forget(const char* name) {
    imc::PlanDB request;
    request.op = imc::PlanDB::Op::DEL;
    request.plan_id = name;
    return ask(request);
  }
  std::string load(const char* name, const messages::InlineMessage& plan = {}) {
    return control(imc::PlanControl::Op::LOAD, name, plan);
  }
  std::string start(const char* name) { return control(imc::PlanControl::Op::START, name, {}); }
  std::string control(std::uint8_t op, const char* name, const messages::InlineMessage& plan) {
    imc::PlanControl request;
    request.op = op;
    request.plan_id = name;
    request.arg = plan;
    return ask(request);
  }
  // where it goes; 0: nowhere
  double depth() {
    adapter.take<&LauvOperator::In::leg>(leg);
    return leg.level;
  }
  std::string name() const { return std::string(to.last<imc::PlanControlState>().plan_id.view()); }
  tasks::Leg leg;
};
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

  TEST_CASE("a plan that is stored is loaded by its name and started, as it was stored last") {
    Planner p;
    CHECK(p.store("dive", dive_plan("dive", 3)) == "");
    CHECK(p.load("dive") == "");
    CHECK(p.op_mode() == OpMode::SERVICE);
    SUBCASE("as it was loaded") {
      CHECK(p.start("dive") == "");
      CHECK(p.depth() == 3);
    }
    SUBCASE("stored anew since") {
      CHECK(p.store("dive", dive_plan("dive", 4)) == "");
      CHECK(p.start("dive") == "");
      CHECK(p.depth() == 4);
    }
    SUBCASE("no name means the loaded one") {
      CHECK(p.store("other", dive_plan("other", 5)) == "");
      CHECK(p.start("") == "");
      CHECK(p.depth() == 3);
    }
    SUBCASE("what is loaded is there though it is stored no more") {
      CHECK(p.forget("dive") == "");
      CHECK(p.start("dive") == "");
      CHECK(p.depth() == 3);
    }
    CHECK(p.op_mode() == OpMode::MANEUVER);
    CHECK(p.name() == "dive");
  }

  TEST_CASE("a plan goes by the name that it was stored or loaded by") {
    Planner p;
    SUBCASE("stored") {
      CHECK(p.store("deep", dive_plan("dive", 6)) == "");
      CHECK(p.load("deep") == "");
    }
    SUBCASE("loaded") { CHECK(p.load("deep", packed(dive_plan("dive", 6))) == ""); }
    CHECK(p.start("dive") == "no plan 'dive' is stored here");
    CHECK(p.start("deep") == "");
    CHECK(p.depth() == 6);
    CHECK(p.name() == "deep");
  }

  TEST_CASE("a plan that can't be flown is not stored, and the one of its name that is stored stays") {
    Planner p;
    CHECK(p.store("dive", dive_plan("dive", 13)) == "maneuver 'dive': z is 13 m; depths are at most 11.5 m");
    CHECK(p.to.last<imc::PlanDB>().type == imc::PlanDB::Type::FAILURE);
    CHECK(p.to.last<imc::LogBookEntry>().text ==
          "plan 'dive' is not stored: maneuver 'dive': z is 13 m; depths are at most 11.5 m");
    CHECK(p.start("dive") == "no plan 'dive' is stored here");
    CHECK(p.store("none", imc::PlanSpecification{}) == "the plan has no maneuver");
    CHECK(p.store("dive", dive_plan("dive", 3)) == "");
    CHECK(p.store("dive", dive_plan("dive", -1)) ==
          "maneuver 'dive': z is -1 m; depths and altitudes are not negative; the plan of that name that is stored "
          "stays");
    CHECK(p.start("dive") == "");
    CHECK(p.depth() == 3);
  }

  TEST_CASE("a plan is stored where places may be anywhere, and loaded where they may not") {
    Planner p;
    CHECK(p.load("good", packed(dive_plan("good", 3))) == "");
    const double north = LauvOperatorParameters{}.latitude + 0.1;
    CHECK(p.store("far", dive_plan("far", 3, north)) == "");
    const char* const why = "maneuver 'dive': its place is 636 km from the origin; places within 100 km are gone to";
    CHECK(p.load("far") == why);
    CHECK(p.start("far") == why);
    CHECK(p.load("far", packed(dive_plan("far", 3, north))) == why);
    CHECK(p.op_mode() == OpMode::SERVICE);
    CHECK(p.start("") == "");
    CHECK(p.depth() == 3);
  }

  TEST_CASE("what is known of a stored plan is given: its size, who stored it and when; all are forgotten at once") {
    using Op = imc::PlanDB::Op;
    Planner p;
    // by a system that says who it is
    const auto ask = [&](std::uint8_t op, const char* name, const messages::InlineMessage& plan = {}) {
      imc::PlanDB request;
      request.op = op;
      request.plan_id = name;
      request.arg = plan;
      const imc::Header from{.src = 0x4001};
      messages::MessageRef message = messages::refer_to(request);
      message.header = &from;
      p.adapter.receive(message);
      p.pass(50ms);
      const auto reply = p.to.last<imc::PlanDB>();
      CHECK(reply.op == op);
      CHECK(reply.type == (reply.info == "" ? imc::PlanDB::Type::SUCCESS : imc::PlanDB::Type::FAILURE));
      return reply;
    };
    const auto opened = [](const messages::InlineMessage& from) {
      messages::Message to;
      REQUIRE(messages::take_inline(imc::message_set(), from, to));
      return to;
    };
    CHECK(ask(Op::GET_INFO, "dive").info == "no plan 'dive' is stored here");
    const auto plan = packed(dive_plan("dive", 3));
    CHECK(ask(Op::SET, "dive", plan).info == "");
    CHECK(ask(Op::SET, "deep", packed(dive_plan("deep", 6))).info == "");
    const auto reply = ask(Op::GET_INFO, "dive");
    CHECK(reply.info == "");
    CHECK(reply.plan_id == "dive");
    const messages::Message given = opened(reply.arg);
    const auto* information = given.as<imc::PlanDBInformation>();
    REQUIRE(information != nullptr);
    CHECK(information->plan_id == "dive");
    CHECK(information->plan_size == plan.payload.size());
    CHECK(information->change_sid == 0x4001);
    CHECK(information->change_time > 1e9);

    CHECK(ask(Op::CLEAR, "").info == "");
    for (const char* name : {"dive", "deep"}) {
      CHECK(std::string(ask(Op::GET_INFO, name).info.view()) == std::string("no plan '") + name + "' is stored here");
      CHECK(p.start(name) == std::string("no plan '") + name + "' is stored here");
    }
    const messages::Message counted = opened(ask(Op::GET_STATE, "").arg);
    const auto* state = counted.as<imc::PlanDBState>();
    REQUIRE(state != nullptr);
    CHECK(state->plan_count == 0);
    CHECK(state->plan_size == 0);
    CHECK(state->change_sid == 0x4001);
    CHECK(state->change_time >= information->change_time);
    CHECK(ask(Op::CLEAR, "").info == "");  // nothing is there
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
