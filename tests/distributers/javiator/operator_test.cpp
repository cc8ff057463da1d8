// In one file: all cases speak with one operator.
#include "distributers/javiator/operator.h"

#include <doctest/doctest.h>

#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/messages/javiator.h"
#include "distributers/messages/packet.h"
#include "tests/distributers/messages/recorded.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace javiator = messages::javiator;

struct SentToOperator : messages::Receiver {
  void receive(messages::MessageRef message) override { all.emplace_back(message); }
  std::vector<messages::Message> all;
};

template <class M>
void send_to(Typed<JaviatorOperator>& adapter, const M& message = {}) {
  adapter.receive(messages::refer_to(message));
}

tasks::PilotCommand take(Typed<JaviatorOperator>& adapter) {
  tasks::PilotCommand command;
  CHECK(adapter.take<&JaviatorOperator::In::command>(command));
  return command;
}

struct Reported {
  javiator::GroundReport report;
  javiator::TraceData trace;
};

Reported send_report(Typed<JaviatorOperator>& adapter, const tasks::HelicopterReport& report) {
  SentToOperator sent;
  adapter.hand_over<&JaviatorOperator::Out::report>(report, sent);
  REQUIRE(sent.all.size() == 2);
  REQUIRE(sent.all[0].as<javiator::GroundReport>() != nullptr);
  REQUIRE(sent.all[1].as<javiator::TraceData>() != nullptr);
  return {*sent.all[0].as<javiator::GroundReport>(), *sent.all[1].as<javiator::TraceData>()};
}

void reach(Typed<JaviatorOperator>& adapter, Duration instant) {
  SentToOperator sent;
  adapter.reach(instant, sent);
  CHECK(sent.all.empty());
}
}  // namespace

TEST_SUITE("distributers/javiator_operator") {
  TEST_CASE("the first switch of a new peer is a hello; the next one counts") {
    Typed<JaviatorOperator> adapter;
    adapter.peer_changed();
    send_to<javiator::SwitchState>(adapter);
    CHECK(take(adapter).state_switches == 0);
    send_to<javiator::SwitchState>(adapter);
    CHECK(take(adapter).state_switches == 1);
    SUBCASE("and so it is after the terminal's restart") {
      adapter.peer_changed();
      send_to<javiator::SwitchState>(adapter);
      CHECK(take(adapter).state_switches == 1);
      send_to<javiator::SwitchState>(adapter);
      CHECK(take(adapter).state_switches == 2);
    }
  }

  TEST_CASE("in a stream, which knows no peers, every switch counts") {
    Typed<JaviatorOperator> adapter;
    send_to<javiator::SwitchState>(adapter);
    CHECK(take(adapter).state_switches == 1);
  }

  TEST_CASE("a new peer whose hello was lost is obeyed from its first switch after a command on") {
    Typed<JaviatorOperator> adapter;
    adapter.peer_changed();
    send_to(adapter, javiator::CommandData{});
    send_to(adapter, javiator::SwitchState{});
    CHECK(take(adapter).state_switches == 1);
  }

  TEST_CASE("a hello does not keep a shut-down from counting") {
    Typed<JaviatorOperator> adapter;
    adapter.peer_changed();
    send_to<javiator::ShutDown>(adapter);
    CHECK(take(adapter).shut_downs == 1);
  }

  TEST_CASE("commands are radians and metres; the first two may mean a place") {
    Typed<JaviatorOperator> adapter;
    send_to(adapter, javiator::CommandData{75, -30, -200, 515});
    const tasks::PilotCommand command = take(adapter);
    CHECK(command.roll == doctest::Approx(0.075));
    CHECK(command.pitch == doctest::Approx(-0.03));
    CHECK(command.yaw == doctest::Approx(-0.2));
    CHECK(command.altitude == doctest::Approx(0.515));
    CHECK(command.y == doctest::Approx(0.075));
    CHECK(command.x == doctest::Approx(-0.03));
  }

  TEST_CASE("the operator is heard in a period in which a command came; keys alone are not enough") {
    Typed<JaviatorOperator> adapter;
    CHECK_FALSE(take(adapter).heard);
    send_to(adapter, javiator::CommandData{0, 0, 0, 500});
    CHECK(take(adapter).heard);
    send_to<javiator::SwitchMode>(adapter);
    const tasks::PilotCommand silent = take(adapter);
    CHECK_FALSE(silent.heard);
    CHECK(silent.altitude == doctest::Approx(0.5));
  }

  TEST_CASE("every key counts, however many come between two periods") {
    Typed<JaviatorOperator> adapter;
    send_to<javiator::SwitchState>(adapter);
    send_to<javiator::SwitchState>(adapter);
    send_to<javiator::SwitchMode>(adapter);
    send_to<javiator::SwitchMode>(adapter);
    send_to<javiator::SwitchMode>(adapter);
    send_to<javiator::ShutDown>(adapter);
    send_to<javiator::StoreTrim>(adapter);
    send_to<javiator::StoreTrim>(adapter);
    send_to<javiator::ClearTrim>(adapter);
    const tasks::PilotCommand command = take(adapter);
    CHECK(command.state_switches == 2);
    CHECK(command.mode_switches == 3);
    CHECK(command.shut_downs == 1);
    CHECK(command.trim_stores == 2);
    CHECK(command.trim_clears == 1);
    CHECK_FALSE(command.heard);
  }

  TEST_CASE("gains and idle signal are handed over once after each change, those that never came as not sent") {
    Typed<JaviatorOperator> adapter;
    tasks::OperatorGains gains;
    CHECK_FALSE(adapter.take<&JaviatorOperator::In::gains>(gains));
    send_to(adapter, javiator::RollPitchParams{1700, 0, 500, -70});
    send_to(adapter, javiator::AltParams{1500, 500, 1000, 50});
    REQUIRE(adapter.take<&JaviatorOperator::In::gains>(gains));
    CHECK(gains.lean.received);
    CHECK(gains.lean.gains.kp == doctest::Approx(1.7));
    CHECK(gains.lean.gains.kd == doctest::Approx(0.5));
    CHECK(gains.lean.gains.kdd == doctest::Approx(-0.07));
    CHECK(gains.altitude.received);
    CHECK(gains.altitude.gains.ki == doctest::Approx(0.5));
    CHECK_FALSE(gains.yaw.received);
    CHECK_FALSE(gains.idle.received);
    CHECK_FALSE(adapter.take<&JaviatorOperator::In::gains>(gains));
    send_to(adapter, javiator::YawParams{1500, 0, 500, 0});
    send_to(adapter, javiator::XYParams{210, 30, -60, 1});
    send_to(adapter, javiator::IdleLimit{8000});
    REQUIRE(adapter.take<&JaviatorOperator::In::gains>(gains));
    CHECK(gains.yaw.gains.kp == doctest::Approx(1.5));
    CHECK(gains.position.gains.kdd == doctest::Approx(0.001));
    CHECK(gains.idle.received);
    CHECK(gains.idle.signal == 8000);
    CHECK(gains.lean.received);
    CHECK_FALSE(take(adapter).heard);  // they are no command
  }

  TEST_CASE("a report has the recorded one's bytes") {
    Typed<JaviatorOperator> adapter;
    tasks::HelicopterReport report;
    report.pressure = 115e3 / 16777216 * 14782186;
    report.temperature = 25.0068;
    report.battery = 14.9942;
    report.signals = {2850, 2850, 2850, 2850};
    report.state = tasks::FlightState::flying;
    for (int i = 1; i < 692; ++i) send_report(adapter, report);
    SentToOperator sent;
    adapter.hand_over<&JaviatorOperator::Out::report>(report, sent);
    std::vector<std::byte> packet;
    REQUIRE(messages::write_packet(messages::Message(*javiator::message_set().header), sent.all[0],
                                   javiator::message_set().order, packet));
    CHECK(messages::hex_of(packet) ==
          "ffff083e00000000000000000000000000000000000000000000000000000000000000000000000018c609c43a920b220b220b220b22"
          "02b40000000000000b2202010457");  // revving up, at 11.0 s
  }

  TEST_CASE("motion is reported in mrad, mm and their rates, cut to whole numbers") {
    Typed<JaviatorOperator> adapter;
    tasks::HelicopterReport report;
    report.roll = 0.0779;
    report.pitch = -0.0109;
    report.yaw = -0.2;
    report.p = 0.019;
    report.x = -0.0055;
    report.y = 4.6179;
    report.altitude = 0.4989;
    report.v_x = -0.007;
    report.v_y = 0.467;
    report.climb = -0.0331;
    report.a_x = 0.1;
    report.a_y = 0.783;
    report.a_up = -0.0239;
    const auto shown = send_report(adapter, report).report.sensors;
    CHECK(shown.roll == 77);
    CHECK(shown.pitch == -10);
    CHECK(shown.yaw == -200);
    CHECK(shown.droll == 19);
    CHECK(shown.x == -5);
    CHECK(shown.y == 4617);
    CHECK(shown.z == 498);
    CHECK(shown.dx == -7);
    CHECK(shown.dy == 467);
    CHECK(shown.dz == -33);
    CHECK(shown.ddx == 100);
    CHECK(shown.ddy == 783);
    CHECK(shown.ddz == -23);
  }

  TEST_CASE("rates are those of Euler's angles, and accelerations 19.79 times their difference") {
    Typed<JaviatorOperator> adapter;
    tasks::HelicopterReport report;
    report.roll = 0.5;
    report.pitch = 0.3;
    report.q = 0.2;
    report.r = 0.1;
    send_report(adapter, {});
    const auto shown = send_report(adapter, report).report.sensors;
    CHECK(shown.droll == 56);    // tan(0.3) (0.2 sin 0.5 + 0.1 cos 0.5)
    CHECK(shown.dpitch == 127);  // 0.2 cos 0.5 - 0.1 sin 0.5
    CHECK(shown.dyaw == 192);    // (0.2 sin 0.5 + 0.1 cos 0.5) / cos 0.3
    CHECK(shown.ddroll == 1124);
    CHECK(shown.ddyaw == 3804);
    CHECK(send_report(adapter, report).report.sensors.ddroll == 0);
  }

  TEST_CASE("what 16 bits can't hold is clipped, but for the pressure, which wraps") {
    Typed<JaviatorOperator> adapter;
    tasks::HelicopterReport report;
    report.altitude = 40;
    report.yaw = -33;
    report.pressure = 65.6;
    const auto shown = send_report(adapter, report).report.sensors;
    CHECK(shown.z == 32767);
    CHECK(shown.yaw == -32768);
    CHECK(shown.maps == 64);
  }

  TEST_CASE("effort is what the signals of the motors have in it") {
    Typed<JaviatorOperator> adapter;
    tasks::HelicopterReport report;
    constexpr double u_z = 7993, u_yaw = 22, u_roll = 3, u_pitch = -5;
    report.signals = {u_z - u_yaw + u_pitch, u_z + u_yaw - u_roll, u_z - u_yaw - u_pitch, u_z + u_yaw + u_roll};
    const javiator::GroundReport shown = send_report(adapter, report).report;
    CHECK(shown.offsets.u_roll == 3);
    CHECK(shown.offsets.u_pitch == -5);
    CHECK(shown.offsets.u_yaw == 22);
    CHECK(shown.offsets.u_z == 7993);
    CHECK(shown.signals.front == 7966);
    CHECK(shown.signals.left == 8018);
  }

  TEST_CASE("states and modes are those that the terminal knows") {
    using tasks::FlightState;
    Typed<JaviatorOperator> adapter;
    tasks::HelicopterReport report;
    const auto state = [&](FlightState s) {
      report.state = s;
      return static_cast<int>(send_report(adapter, report).report.state_mode.state);
    };
    CHECK(state(FlightState::halt) == 4);
    CHECK(state(FlightState::ground) == 1);
    CHECK(state(FlightState::starting) == 2);
    CHECK(state(FlightState::flying) == 2);
    CHECK(state(FlightState::landing) == 2);
    CHECK(send_report(adapter, report).report.state_mode.mode == 1);
    send_to<javiator::SwitchMode>(adapter);
    CHECK(send_report(adapter, report).report.state_mode.mode == 2);
    send_to<javiator::SwitchMode>(adapter);
    CHECK(send_report(adapter, report).report.state_mode.mode == 1);
  }

  TEST_CASE("a trace has the state of the report before, and times of the logical clock") {
    Typed<JaviatorOperator> adapter;
    tasks::HelicopterReport report;
    report.roll_goal = 0.074;
    report.pitch_goal = -0.01;
    reach(adapter, 15ms);
    take(adapter);
    reach(adapter, 25ms);
    send_report(adapter, report);
    reach(adapter, 30ms);
    take(adapter);
    reach(adapter, 40ms);
    report.state = tasks::FlightState::ground;
    javiator::TraceData trace = send_report(adapter, report).trace;
    CHECK(trace.cmd_roll == 74);
    CHECK(trace.cmd_pitch == -10);
    CHECK(trace.period_ms == 15);
    CHECK(trace.state == 4);
    CHECK(trace.t_loop_start == 30000);
    CHECK(trace.t_terminal_input == 30000);
    CHECK(trace.t_control == 40000);
    CHECK(trace.t_report == 25000);
    CHECK(send_report(adapter, report).trace.state == 1);
    SUBCASE("which begin anew after 1000 s") {
      reach(adapter, 1000s + 15ms);
      take(adapter);
      trace = send_report(adapter, report).trace;
      CHECK(trace.t_loop_start == 15000);
    }
  }
}
