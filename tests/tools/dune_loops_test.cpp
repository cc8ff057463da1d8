// The shipped graph, and a full DUNE that flies a plan of its own: what DUNE sent in a dive is given by hand to the
// submarine's distributer, what this makes of it to the graph, and what the graph commands to the distributer again,
// which passes it on or not. There is no link, and as the dive is a recording, nothing that is commanded changes it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/messages/packet.h"
#include "tasks/values/alarm.h"
#include "tests/tools/recorded_packets.h"
#include "tools/library/session.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using distributers::LauvVehicle;
using tasks::Alarm;
using tasks::FinState;
using tasks::Instruments;
using test::packets_of;

distributers::LauvVehicleParameters parameters_of(const Graph& graph) {
  for (const Distributer& d : graph.distributers)
    if (d.name == "dune") return *static_cast<const distributers::LauvVehicleParameters*>(d.parameters.data());
  FAIL("no distributer 'dune'");
  return {};
}

// But the question for its labels.
struct Sent : messages::Receiver {
  void receive(messages::MessageRef message) override {
    if (message.as<messages::imc::EntityList>() == nullptr) names.emplace_back(message.descriptor->name);
  }
  std::vector<std::string> names;
};
}  // namespace

TEST_SUITE("tools/dune_loops") {
  TEST_CASE(
      "while DUNE's own loops are on its distributer sends it nothing of what the graph commands, which follows the "
      "recorded dive without an alarm; as soon as they are off it sends that") {
    Sent sent;
    auto session =
        jarol::open("specs/exolauv.yaml", {.profile = "dune", .set = {"expect=nothing"}, .fed = {"dune", "neptus"}});
    distributers::Typed<LauvVehicle> adapter(parameters_of(session.graph()));
    messages::PacketReader reader(LauvVehicle::message_set());
    const auto packets = packets_of("tests/data/dune-dive.packets");
    const auto say_loops = [&](std::uint32_t loops) {
      messages::imc::VehicleState state;
      state.control_loops = loops;
      adapter.receive(messages::refer_to(state));
    };
    const auto hand_over = [&] {
      adapter.hand_over<&LauvVehicle::Out::actuation>(session.value<tasks::Actuation>("fins.actuation"), sent);
    };
    session.feed("neptus.setpoint", tasks::Setpoint{3, 0, 1.2});  // what it would do
    Instruments instruments;
    tasks::Servos servos;
    std::size_t next = 0;
    std::int64_t steps = 0;
    double max_thrust = 0, worst = 0;
    for (; packets[next].seconds + 0.05 < packets.back().seconds; ++steps) {
      if (steps % 20 == 0) say_loops(0x4C9);  // as in its Goto: path, depth, yaw, speed, torque
      for (; packets[next].seconds <= seconds(session.now()); ++next) {
        REQUIRE(reader.read(packets[next].bytes) == messages::PacketError::none);
        adapter.receive(reader.message());
      }
      adapter.reach(session.now(), sent);
      if (adapter.take<&LauvVehicle::In::instruments>(instruments)) session.feed("dune.instruments", instruments);
      if (adapter.take<&LauvVehicle::In::servos>(servos)) session.feed("dune.servos", servos);
      session.run_for(50ms);
      hand_over();
      CHECK(session.value<tasks::Condition>("supervisor.condition").alarm == Alarm::none);
      if (steps < 10) continue;
      for (const FinState fin : session.value<tasks::FinCondition>("fin_watch.fins").states)
        CHECK(fin == FinState::follows);
      worst = std::max(worst, std::abs(session.value<tasks::Motion>("navigation.motion").z - instruments.depth.value));
      max_thrust = std::max(max_thrust, session.value<tasks::Actuation>("fins.actuation").thruster);
    }
    CHECK(steps > 790);
    CHECK(sent.names.empty());
    CHECK(max_thrust > 0.4);
    CHECK(worst < 0.1);
    const auto motion = session.value<tasks::Motion>("navigation.motion");
    CHECK(motion.z == doctest::Approx(3).scale(0).epsilon(0.01));
    CHECK(motion.u == doctest::Approx(1.2).scale(0).epsilon(0.05));
    say_loops(0);
    hand_over();
    CHECK(sent.names == std::vector<std::string>{"SetThrusterActuation", "SetServoPosition", "SetServoPosition",
                                                 "SetServoPosition", "SetServoPosition"});
  }
}
