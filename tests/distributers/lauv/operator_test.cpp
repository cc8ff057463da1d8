// What the submarine's operator is sent, and what answers get.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "graph/math/geometry.h"
#include "tests/distributers/lauv_console.h"

namespace {
using namespace jarol;
using namespace jarol::tests;

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
    distributers::Typed<LauvOperator> adapter;
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
    CHECK(entities.list == "Daemon=0;Operator=1;Supervisor=2;Navigation=3;Plan Engine=4");
    c.pass(50ms);
    CHECK(c.to.all<imc::EntityList>().size() == 1);
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

  TEST_CASE("a negative depth is the surface, a negative speed none, and the log book says so") {
    Conversation c;
    for (const double before : {0, 3}) {
      c.say(imc::DesiredZ{static_cast<float>(before), imc::ZUnits::DEPTH});
      c.say(imc::DesiredZ{-2, imc::ZUnits::DEPTH});
      c.pass(50ms);
      CHECK(c.setpoint().depth == 0);
      CHECK(c.to.last<imc::LogBookEntry>().text == "DesiredZ is -2 m; depths are not negative: it goes to the surface");
    }
    c.say(imc::DesiredSpeed{-1, imc::SpeedUnits::METERS_PS});
    c.pass(50ms);
    CHECK(c.setpoint().speed == 0);
    CHECK(c.to.last<imc::LogBookEntry>().text ==
          "DesiredSpeed is negative; astern it goes by % only: the propeller stops");
  }

  TEST_CASE("while the vehicle comes up by itself no control loop of the operator is on, and no maneuver is flown") {
    for (const bool by_hand : {false, true}) {
      CAPTURE(by_hand);
      Conversation c;
      by_hand ? c.act("Thrust=50") : c.say(imc::DesiredSpeed{1, imc::SpeedUnits::METERS_PS});
      c.pass(50ms);
      CHECK(c.to.last<imc::VehicleState>().control_loops != 0);
      c.report({.alarm = tasks::Alarm::leak});
      for (const Duration time : {50ms, 3000ms}) {
        // what is commanded meanwhile changes nothing
        by_hand ? c.act("Thrust=60") : c.say(imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS});
        c.pass(time);
        const auto state = c.to.last<imc::VehicleState>();
        CHECK(state.op_mode == OpMode::ERROR);
        CHECK(state.control_loops == 0);
        CHECK(state.maneuver_type == 0xffff);
        CHECK(state.maneuver_stime == 0);
        CHECK(state.maneuver_eta == 0xffff);
      }
      c.report({.alarm = tasks::Alarm::none});
      c.say(imc::DesiredSpeed{1, imc::SpeedUnits::METERS_PS});
      c.pass(50ms);
      CHECK(c.to.last<imc::VehicleState>().control_loops != 0);
    }
  }

  TEST_CASE("another who has the link is the operator from when it commands, not from when it is heard") {
    for (const bool by_hand : {false, true}) {
      Conversation c;
      const auto command = [&] {
        by_hand ? c.act("Thrust=50") : c.say(imc::DesiredSpeed{1, imc::SpeedUnits::METERS_PS});
      };
      command();
      c.pass(3s);
      c.adapter.peer_changed();
      c.say(imc::Heartbeat{});
      c.pass(1s);
      CHECK(c.silence() == 4);
      command();
      CHECK(c.silence() == 0);
      c.pass(1s);
      c.say(imc::Heartbeat{});
      CHECK(c.silence() == 0);
    }
  }

  TEST_CASE("of two that share a link the one that commanded last is the operator: the other's words are no contact") {
    Conversation c;
    const auto say_as = [&](std::uint16_t who, const auto& message) {
      const imc::Header from{.src = who};
      messages::MessageRef said = messages::refer_to(message);
      said.header = &from;
      c.adapter.receive(said);
    };
    const imc::DesiredSpeed speed{1, imc::SpeedUnits::METERS_PS};
    c.pass(1s);
    say_as(0x4002, imc::Heartbeat{});  // before anybody has commanded, each counts
    CHECK(c.silence() == 0);
    say_as(0x4001, speed);
    c.pass(3s);
    say_as(0x4002, imc::Heartbeat{});
    CHECK(c.silence() == 3);
    say_as(0x4001, imc::Heartbeat{});
    CHECK(c.silence() == 0);
    c.pass(1s);
    say_as(0x4002, speed);
    CHECK(c.silence() == 0);
    c.pass(2s);
    say_as(0x4001, imc::Heartbeat{});
    CHECK(c.silence() == 2);
  }

  TEST_CASE("a report becomes an EstimatedState, until the whole motion is reported") {
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
    c.adapter.hand_over<&LauvOperator::Out::motion>(motion, c.to);
    state = c.to.last<imc::EstimatedState>();
    CHECK(state.x == 10.0F);
    CHECK(state.vx == doctest::Approx(-0.5));
    CHECK(state.vy == doctest::Approx(1));
    CHECK(state.r == 0.25F);
    // in a stream: the same through the water, and over ground what the water brings
    c.adapter.hand_over<&LauvOperator::Out::stream>({.north = 0.25, .east = -0.75}, c.to);
    CHECK(c.to.last<imc::EstimatedStreamVelocity>().x == 0.25);
    CHECK(c.to.last<imc::EstimatedStreamVelocity>().y == -0.75);
    c.adapter.hand_over<&LauvOperator::Out::motion>(motion, c.to);
    state = c.to.last<imc::EstimatedState>();
    CHECK(state.u == 1.0F);
    CHECK(state.vx == doctest::Approx(-0.25));
    CHECK(state.vy == doctest::Approx(0.25));
    c.report({.depth = 9});
    CHECK(c.to.all<imc::EstimatedState>().size() == 3);
  }

  TEST_CASE("why the supervisor brings it up is reported at once") {
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
