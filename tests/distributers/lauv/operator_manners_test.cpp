// How a vehicle answers its consoles, as DUNE does.
// In one file: all cases speak with one vehicle.
#include <doctest/doctest.h>

#include "distributers/messages/payload.h"
#include "tests/distributers/lauv/inline_messages.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;

// What goes out with its header.
struct Addressed : messages::Receiver {
  struct Sent {
    std::string name;
    imc::Header header;
  };
  void receive(messages::MessageRef message) override {
    const auto* header = static_cast<const imc::Header*>(message.header);
    sent.push_back({std::string(message.descriptor->name), header == nullptr ? imc::Header{} : *header});
  }
  const imc::Header& header_of(const std::string& name) const {
    for (const Sent& each : sent)
      if (each.name == name) return each.header;
    FAIL("no " << name);
    throw 0;
  }
  std::vector<Sent> sent;
};

template <class M>
M opened(const messages::InlineMessage& from) {
  messages::Message to;
  REQUIRE(messages::take_inline(imc::message_set(), from, to));
  REQUIRE(to.as<M>() != nullptr);
  return *to.as<M>();
}

imc::PlanSpecification idle_plan(const char* name, std::uint16_t duration = 5) {
  imc::PlanSpecification plan;
  plan.plan_id = name;
  plan.start_man_id = "wait";
  imc::PlanManeuver named;
  named.maneuver_id = "wait";
  imc::IdleManeuver idle;
  idle.duration = duration;
  named.data = packed(idle);
  plan.maneuvers.push_back(packed(named));
  return plan;
}

imc::PlanDB request(std::uint8_t op, const char* name) {
  imc::PlanDB made;
  made.op = op;
  made.request_id = 3;
  made.plan_id = name;
  return made;
}
}  // namespace

TEST_SUITE("distributers/lauv_operator_manners") {
  TEST_CASE("asked for the states of its entities each answers, and what it is on its own question") {
    Conversation c;
    c.say(imc::QueryEntityState{});
    c.pass(50ms);
    CHECK(c.to.all<imc::EntityState>().size() == 5);
    for (const auto& state : c.to.all<imc::EntityState>()) CHECK(state.state == imc::EntityState::State::NORMAL);
    c.report({.alarm = tasks::Alarm::leak});
    c.say(imc::QueryEntityState{});
    c.pass(50ms);
    const auto states = c.to.all<imc::EntityState>();
    REQUIRE(states.size() == 10);
    CHECK(states[7].state == imc::EntityState::State::FAILURE);
    CHECK(states[7].description == "leak");
    imc::QueryEntityInfo query;
    query.id = 2;
    c.say(query);
    query.id = 77;
    c.say(query);
    c.pass(50ms);
    REQUIRE(c.to.all<imc::EntityInfo>().size() == 1);
    CHECK(c.to.last<imc::EntityInfo>().id == 2);
    CHECK(c.to.last<imc::EntityInfo>().label == "Supervisor");
  }

  TEST_CASE("who speaks stands in the header, and an answer goes to who has asked") {
    distributers::Typed<LauvOperator> adapter;
    Addressed to;
    const imc::Header from{.src = 0x4001, .src_ent = 9};
    messages::MessageRef question = messages::refer_to(imc::QueryEntityState{});
    const imc::QueryEntityState query;
    question = messages::refer_to(query);
    question.header = &from;
    adapter.receive(question);
    adapter.hand_over<&LauvOperator::Out::motion>({}, to);
    adapter.reach(0ms, to);
    CHECK(to.header_of("EntityState").dst == 0x4001);
    CHECK(to.header_of("EntityState").dst_ent == 9);
    CHECK(to.header_of("EntityState").src_ent == 0);
    CHECK(to.header_of("VehicleState").src_ent == 2);
    CHECK(to.header_of("VehicleState").dst == 0xffff);
    CHECK(to.header_of("EstimatedState").src_ent == 3);
    CHECK(to.header_of("PlanControlState").src_ent == 4);
  }

  TEST_CASE("the log book keeps what went wrong and what was flown, gives it, by severity and time, and forgets it") {
    Conversation c;
    c.say(imc::DesiredZ{3, imc::ZUnits::ALTITUDE});
    c.report({.alarm = tasks::Alarm::leak});
    const auto lines = [&](std::uint8_t command, double since = 0) {
      imc::LogBookControl control;
      control.command = command;
      control.htime = since;
      c.say(control);
      c.pass(50ms);
      const auto reply = c.to.last<imc::LogBookControl>();
      CHECK(reply.command == imc::LogBookControl::Command::REPLY);
      std::vector<std::string> all;
      for (const auto& line : reply.msg) all.emplace_back(opened<imc::LogBookEntry>(line).text.view());
      return all;
    };
    using Command = imc::LogBookControl::Command;
    const std::vector<std::string> errors{"the vehicle comes up: leak"};
    CHECK(lines(Command::GET) == std::vector<std::string>{"DesiredZ is taken as a depth in m only", errors[0]});
    CHECK(lines(Command::GET_ERR) == errors);
    CHECK(lines(Command::GET, 4e9).empty());
    imc::LogBookControl clear;
    clear.command = Command::CLEAR;
    c.say(clear);
    CHECK(lines(Command::GET).empty());
  }

  TEST_CASE("a plan is stored, listed, given back as it was, started by its name, and deleted") {
    using Op = imc::PlanDB::Op;
    Conversation c;
    const auto ask = [&](const imc::PlanDB& question) {
      c.say(question);
      c.pass(50ms);
      const auto reply = c.to.last<imc::PlanDB>();
      CHECK(reply.request_id == 3);
      CHECK(reply.op == question.op);
      CHECK((reply.type == imc::PlanDB::Type::SUCCESS) == reply.info.empty());
      return reply;
    };
    auto set = request(Op::SET, "wait");
    CHECK(ask(set).info == "there is no PlanSpecification in it");
    set.arg = packed(idle_plan("wait"));
    CHECK(ask(set).info == "");
    set.plan_id = "";
    CHECK(ask(set).info == "the plan has no name");
    CHECK(opened<imc::PlanSpecification>(ask(request(Op::GET, "wait")).arg).start_man_id == "wait");
    CHECK(ask(request(Op::GET, "other")).info == "no plan 'other' is stored here");
    const auto state = opened<imc::PlanDBState>(ask(request(Op::GET_DSTATE, "")).arg);
    CHECK(state.plan_count == 1);
    REQUIRE(state.plans_info.size() == 1);
    const auto information = opened<imc::PlanDBInformation>(state.plans_info[0]);
    CHECK(information.plan_id == "wait");
    CHECK(information.plan_size == packed(idle_plan("wait")).payload.size());
    CHECK(state.plan_size == information.plan_size);
    CHECK(opened<imc::PlanDBState>(ask(request(Op::GET_STATE, "")).arg).plans_info.empty());
    imc::PlanControl start;
    start.plan_id = "wait";
    c.say(start);
    c.pass(50ms);
    CHECK(c.to.last<imc::PlanControl>().type == imc::PlanControl::Type::SUCCESS);
    CHECK(c.to.last<imc::PlanControlState>().man_id == "wait");
    CHECK(ask(request(Op::DEL, "wait")).info == "");
    CHECK(ask(request(Op::DEL, "wait")).info == "no plan 'wait' is stored here");
    CHECK(ask(request(9, "")).info == "operation 9 is none of SET, DEL, GET, GET_INFO, CLEAR, GET_STATE, GET_DSTATE");
    auto answer = request(Op::GET, "wait");
    answer.type = imc::PlanDB::Type::SUCCESS;
    const std::size_t answers = c.to.all<imc::PlanDB>().size();
    c.say(answer);
    c.pass(50ms);
    CHECK(c.to.all<imc::PlanDB>().size() == answers);
  }

  TEST_CASE("every request about plans is answered, a bad one too, and in words") {
    Conversation c;
    const auto ask = [&](imc::PlanControl control) {
      const std::size_t before = c.to.all<imc::PlanControl>().size();
      c.say(control);
      c.pass(50ms);
      CHECK(c.to.all<imc::PlanControl>().size() == before + 1);
      const auto reply = c.to.last<imc::PlanControl>();
      CHECK((reply.type == imc::PlanControl::Type::SUCCESS) == reply.info.empty());
      return std::string(reply.info.view());
    };
    using Op = imc::PlanControl::Op;
    imc::PlanControl control;
    control.op = 17;
    CHECK(ask(control) == "operation 17 is none of START, STOP, LOAD, GET");
    control.op = Op::GET;
    CHECK(ask(control) == "no plan is loaded");
    control.op = Op::LOAD;
    control.plan_id = "x";
    CHECK(ask(control) == "no plan 'x' is stored here");
    control.arg = packed(imc::IdleManeuver{});
    CHECK(ask(control) == "IdleManeuver is no plan");
    control.arg = packed(imc::PlanSpecification{});
    CHECK(ask(control) == "the plan has no maneuver");
    control.arg.payload.resize(2);
    CHECK(ask(control) ==
          "the plan can't be read: field 'description' of PlanSpecification needs 2 bytes where 0 are left");
    control.arg = packed(idle_plan("x"));
    CHECK(ask(control) == "");
    control.op = Op::GET;
    control.arg = {};
    CHECK(ask(control) == "");
    CHECK(opened<imc::PlanSpecification>(c.to.last<imc::PlanControl>().arg).plan_id == "x");
    c.report({.alarm = tasks::Alarm::gps});
    control.op = Op::START;
    CHECK(ask(control) == "the vehicle comes up: gps");
  }

  TEST_CASE("a leg is over when the vehicle says so of that leg, and a maneuver fails when its time is up") {
    Conversation c;
    auto plan = idle_plan("two", 100);
    imc::PlanManeuver named;
    named.maneuver_id = "go";
    imc::Goto there;
    there.lat = LauvOperatorParameters{}.latitude;
    there.lon = LauvOperatorParameters{}.longitude;
    there.z_units = imc::ZUnits::DEPTH;
    there.speed = 1;
    there.timeout = 20;
    named.data = packed(there);
    plan.maneuvers.push_back(packed(named));
    imc::PlanTransition transition;
    transition.source_man = ".";
    transition.dest_man = "go";
    transition.conditions = "ManeuverIsDone";
    plan.transitions.push_back(packed(transition));
    imc::PlanControl start;
    start.arg = packed(plan);
    c.say(start);
    c.pass(50ms);
    const auto report = [&](std::uint32_t leg, bool done) {
      c.adapter.hand_over<&LauvOperator::Out::progress>({.on_leg = leg, .done = done, .left = 12}, c.to);
      c.pass(50ms);
      return std::string(c.to.last<imc::PlanControlState>().man_id.view());
    };
    tasks::Leg leg;
    REQUIRE(c.adapter.take<&LauvOperator::In::leg>(leg));
    CHECK(leg.course == tasks::Course::rest);
    CHECK(report(leg.number, false) == "wait");
    CHECK(report(leg.number + 1, true) == "wait");
    CHECK(c.to.last<imc::VehicleState>().maneuver_stime > 1e9);
    CHECK(report(leg.number, true) == "go");
    REQUIRE(c.adapter.take<&LauvOperator::In::leg>(leg));
    CHECK(leg.course == tasks::Course::line);
    c.pass(19s);
    CHECK(c.op_mode() == OpMode::MANEUVER);
    CHECK(c.silence() == 0);
    c.pass(2s);
    CHECK(c.op_mode() == OpMode::SERVICE);
    CHECK(c.to.last<imc::VehicleState>().last_error == "maneuver 'go' took longer than 20 s");
    CHECK(c.to.last<imc::PlanControlState>().last_outcome == imc::PlanControlState::LastOutcome::FAILURE);
    REQUIRE(c.adapter.take<&LauvOperator::In::leg>(leg));
    CHECK(leg.course == tasks::Course::none);
  }

  TEST_CASE("while a plan runs a stick counts for nothing, and another command ends it") {
    Conversation c;
    imc::PlanControl start;
    start.arg = packed(imc::IdleManeuver{});
    c.say(start);
    c.act("Heading=0;Thrust=50");
    c.pass(50ms);
    CHECK(c.to.last<imc::VehicleState>().maneuver_type == imc::IdleManeuver::message_id);
    c.say(imc::DesiredSpeed{1, imc::SpeedUnits::METERS_PS});
    c.pass(50ms);
    CHECK(c.op_mode() == OpMode::EXTERNAL);
    CHECK(c.setpoint().speed == 1);
    CHECK(c.to.last<imc::PlanControlState>().last_outcome == imc::PlanControlState::LastOutcome::FAILURE);
  }

  TEST_CASE("references count of the system that the maneuver names") {
    Conversation c;
    imc::FollowReference follow;
    follow.control_src = 0x4002;
    follow.control_ent = 0xff;
    imc::PlanControl start;
    start.arg = packed(follow);
    c.say(start);
    c.pass(50ms);
    imc::Reference reference;
    reference.flags = imc::Reference::Flags::MANDONE;
    const auto refer = [&](std::uint16_t who) {
      const imc::Header from{.src = who};
      messages::MessageRef message = messages::refer_to(reference);
      message.header = &from;
      c.adapter.receive(message);
      c.pass(50ms);
    };
    refer(0x4001);
    CHECK(c.op_mode() == OpMode::MANEUVER);
    refer(0x4002);
    CHECK(c.op_mode() == OpMode::SERVICE);
    CHECK(c.to.last<imc::PlanControlState>().last_outcome == imc::PlanControlState::LastOutcome::SUCCESS);
  }
}
