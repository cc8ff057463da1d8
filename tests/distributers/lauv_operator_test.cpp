#include "distributers/lauv_operator.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "distributers/messages/imc.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace imc = messages::imc;
using tasks::Drive;
using tasks::Turn;

constexpr double degree = std::numbers::pi / 180;

// What the console gets.
struct Console : messages::Receiver {
  void receive(messages::MessageRef message) override { got.emplace_back(message); }

  template <class M>
  std::vector<M> all() const {
    std::vector<M> found;
    for (const messages::Message& message : got)
      if (const M* m = message.as<M>()) found.push_back(*m);
    return found;
  }
  template <class M>
  M last() const {
    const auto found = all<M>();
    REQUIRE_FALSE(found.empty());
    return found.back();
  }
  std::vector<messages::Message> got;
};

// A run of 50 ms steps that nothing but the console takes part in.
struct Conversation {
  explicit Conversation(const LauvOperatorParameters& parameters = {}) : adapter(parameters) { adapter.reach(0ms, to); }

  template <class M>
  void say(const M& message) {
    adapter.receive(messages::refer_to(message));
  }
  void act(const char* actions) { say(imc::RemoteActions{actions}); }
  void pass(Duration time) {
    for (const Duration end = now + time; now < end;) adapter.reach(now += 50ms, to);
  }
  void report(const tasks::VehicleReport& told) { adapter.hand_over(3, &told, to); }
  tasks::Setpoint setpoint() {
    adapter.take(0, &value);
    return value;
  }
  double silence() {
    tasks::Contact contact;
    REQUIRE(adapter.take(2, &contact));
    return contact.silence;
  }
  std::uint8_t op_mode() const { return to.last<imc::VehicleState>().op_mode; }

  LauvOperator adapter;
  Console to;
  Duration now{};
  tasks::Setpoint value;
};

void check(const tasks::Setpoint& is, const tasks::Setpoint& wanted) {
  CHECK(is.depth == wanted.depth);
  CHECK(is.heading == doctest::Approx(wanted.heading));
  CHECK(is.speed == wanted.speed);
  CHECK(is.turn == wanted.turn);
  CHECK(is.rate == doctest::Approx(wanted.rate));
  CHECK(is.drive == wanted.drive);
  CHECK(is.thrust == doctest::Approx(wanted.thrust));
}

tasks::Setpoint by_hand(double rate, double thrust) { return {0, 0, 0, Turn::rate, rate, Drive::thrust, thrust}; }

using OpMode = imc::VehicleState::OpMode;
}  // namespace

TEST_SUITE("distributers/lauv_operator") {
  TEST_CASE("a heartbeat, a vehicle state and a state of plans go out each second") {
    Conversation c;
    c.pass(4950ms);
    CHECK(c.to.all<imc::Heartbeat>().size() == 5);
    CHECK(c.to.all<imc::VehicleState>().size() == 5);
    CHECK(c.to.all<imc::PlanControlState>().size() == 5);
    const auto state = c.to.last<imc::VehicleState>();
    CHECK(state.op_mode == OpMode::SERVICE);
    CHECK(state.error_count == 0);
    CHECK(state.error_ents == "");
    CHECK(state.maneuver_type == 0xffff);
    CHECK(state.maneuver_eta == 0xffff);
    CHECK(state.control_loops == 0);
    CHECK(state.last_error == "");
    CHECK(c.to.last<imc::PlanControlState>().state == imc::PlanControlState::State::READY);
  }

  TEST_CASE("it announces itself every ten seconds, with the address at which it is reached") {
    LauvOperator adapter({});
    Console all;
    adapter.listen_at("udp://127.0.0.1:6001");
    for (Duration now{}; now < 25s; now += 50ms) adapter.announce(now, all);
    CHECK(all.got.size() == 3);
    const auto announce = all.last<imc::Announce>();
    CHECK(announce.sys_name == "lauv-simulator-1");
    CHECK(announce.sys_type == imc::SystemType::UUV);
    CHECK(announce.owner == 0xffff);
    CHECK(announce.lat == doctest::Approx(41.1850 * degree));
    CHECK(announce.lon == doctest::Approx(-8.7062 * degree));
    CHECK(announce.services == "imc+info://0.0.0.0/version/5.4.31;imc+udp://127.0.0.1:6001/");
  }

  TEST_CASE("depth, heading and speed become one setpoint, taken once after each change") {
    Conversation c;
    tasks::Setpoint value;
    CHECK_FALSE(c.adapter.take(0, &value));
    c.say(imc::DesiredZ{3, imc::ZUnits::DEPTH});
    c.say(imc::DesiredHeading{90 * degree});
    c.say(imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS});
    CHECK(c.adapter.take(0, &value));
    check(value, {3, 90 * degree, 1.2});
    CHECK_FALSE(c.adapter.take(0, &value));
    c.pass(50ms);
    const auto state = c.to.last<imc::VehicleState>();
    CHECK(state.op_mode == OpMode::EXTERNAL);
    CHECK(state.control_loops == 0x4c8);  // depth, yaw, speed, torque
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
    CHECK_FALSE(c.adapter.take(0, &c.value));
    CHECK(c.op_mode() == OpMode::SERVICE);
  }

  TEST_CASE("asked for its actions and entities it lists them; answers of others are no questions") {
    Conversation c;
    c.say(imc::RemoteActionsRequest{imc::RemoteActionsRequest::Op::REPORT, "X=Button"});
    c.say(imc::EntityList{imc::EntityList::Op::REPORT, "X=1"});
    c.pass(50ms);
    CHECK(c.to.all<imc::RemoteActionsRequest>().empty());
    CHECK(c.to.all<imc::EntityList>().empty());
    c.say(imc::RemoteActionsRequest{imc::RemoteActionsRequest::Op::QUERY, ""});
    c.say(imc::EntityList{imc::EntityList::Op::QUERY, ""});
    c.pass(50ms);
    const auto actions = c.to.last<imc::RemoteActionsRequest>();
    CHECK(actions.op == imc::RemoteActionsRequest::Op::REPORT);
    CHECK(actions.actions ==
          "Exit=Button;Accelerate=Button;Decelerate=Button;Stop=Button;Heading=Axis;Thrust=Axis;Ranges=Range127");
    const auto entities = c.to.last<imc::EntityList>();
    CHECK(entities.op == imc::EntityList::Op::REPORT);
    CHECK(entities.list == "Daemon=0;Operator=1;Supervisor=2");
    c.pass(50ms);
    CHECK(c.to.all<imc::EntityList>().size() == 1);
  }

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

  TEST_CASE("exit ends the steering by hand") {
    Conversation c;
    c.act("Heading=127;Thrust=127");
    c.act("Exit=1");
    check(c.setpoint(), {0, 0, 0});
    c.pass(50ms);
    CHECK(c.op_mode() == OpMode::SERVICE);
    CHECK(c.to.all<imc::TeleoperationDone>().size() == 1);
  }

  TEST_CASE("a plan of teleoperation is started and stopped; others are refused in words") {
    Conversation c;
    imc::PlanControl request;
    request.op = imc::PlanControl::Op::START;
    request.request_id = 7;
    request.plan_id = "by hand";
    request.arg.id = 452;
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
    request.arg.id = 450;
    c.say(request);
    c.pass(50ms);
    reply = c.to.last<imc::PlanControl>();
    CHECK(reply.type == imc::PlanControl::Type::FAILURE);
    CHECK(reply.info == "no other maneuver than Teleoperation is known here");
    CHECK(c.op_mode() == OpMode::SERVICE);
  }

  TEST_CASE("a vehicle command executes and stops the same maneuver") {
    Conversation c;
    imc::VehicleCommand request;
    request.request_id = 9;
    request.maneuver.id = 452;
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

  TEST_CASE("thruster and servo commands become an actuation by hand") {
    Conversation c;
    tasks::Actuation value;
    CHECK_FALSE(c.adapter.take(1, &value));
    c.say(imc::SetThrusterActuation{0, 0.5F});
    c.say(imc::SetServoPosition{2, 0.25F});
    c.say(imc::SetServoPosition{4, 1});      // there is no such fin
    c.say(imc::SetThrusterActuation{1, 1});  // nor such a thruster
    CHECK(c.adapter.take(1, &value));
    CHECK(value.thruster == 0.5);
    CHECK(value.fins == std::array<double, 4>{0, 0, 0.25, 0});
    CHECK_FALSE(c.adapter.take(1, &value));
  }

  TEST_CASE("the operator's silence counts while something is asked of the vehicle") {
    Conversation c;
    c.pass(10s);
    CHECK(c.silence() == 0);
    c.say(imc::DesiredZ{3, imc::ZUnits::DEPTH});
    c.pass(3s);
    CHECK(c.silence() == 3);
    c.say(imc::Heartbeat{});
    CHECK(c.silence() == 0);
    c.pass(1s);
    c.say(imc::Abort{});
    c.pass(9s);
    CHECK(c.silence() == 0);
  }

  TEST_CASE("a report becomes an EstimatedState, until the whole motion is told") {
    Conversation c;
    c.report({.depth = 3, .pitch = 0.5, .heading = 1, .speed = 2});
    auto state = c.to.last<imc::EstimatedState>();
    CHECK(state.lat == doctest::Approx(41.1850 * degree));
    CHECK(state.z == 3.0F);
    CHECK(state.depth == 3.0F);
    CHECK(state.alt == -1.0F);
    CHECK(state.theta == 0.5F);
    CHECK(state.psi == 1.0F);
    CHECK(state.u == 2.0F);
    CHECK(state.vz == doctest::Approx(-2 * std::sin(0.5)));
    tasks::Motion motion;
    motion.x = 10;
    motion.psi = 90 * degree;
    motion.u = 1;
    motion.v = 0.5;
    motion.r = 0.25;
    c.adapter.hand_over(4, &motion, c.to);
    state = c.to.last<imc::EstimatedState>();
    CHECK(state.x == 10.0F);
    CHECK(state.vx == doctest::Approx(-0.5));
    CHECK(state.vy == doctest::Approx(1));
    CHECK(state.r == 0.25F);
    c.report({.depth = 9});
    CHECK(c.to.all<imc::EstimatedState>().size() == 2);
  }

  TEST_CASE("why the supervisor brings it up is told at once") {
    Conversation c;
    c.report({.alarm = tasks::Alarm::leak});
    c.pass(50ms);
    const auto state = c.to.last<imc::VehicleState>();
    CHECK(state.op_mode == OpMode::ERROR);
    CHECK(state.error_count == 1);
    CHECK(state.error_ents == "Supervisor");
    CHECK(state.last_error == "leak");
    CHECK(c.to.last<imc::PlanControlState>().state == imc::PlanControlState::State::BLOCKED);
  }
}
