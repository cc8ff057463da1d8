// A vehicle whose own controllers steer it, as a DUNE that flies a plan, is left alone until they are off.
#include <doctest/doctest.h>

#include <chrono>
#include <utility>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/payload.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
namespace imc = messages::imc;

struct Counted : messages::Receiver {
  void receive(messages::MessageRef) override { ++sent; }
  int sent = 0;
};

// How many messages an actuation becomes, after the vehicle has said which loops are on.
int sent_by(Typed<LauvVehicle>& adapter, std::uint32_t loops) {
  imc::VehicleState state;
  state.control_loops = loops;
  adapter.receive(messages::refer_to(state));
  Counted counted;
  adapter.hand_over<&LauvVehicle::Out::actuation>({0.5, {0.1, 0.2, 0.3, 0.4}}, counted);
  return counted.sent;
}
}  // namespace

TEST_SUITE("distributers/lauv_vehicle/own_loops") {
  TEST_CASE("while control loops of the vehicle's own are on nothing is sent, and all as soon as they are off") {
    using Loops = imc::CLoopsMask;
    Typed<LauvVehicle> adapter;
    CHECK(sent_by(adapter, 0) == 5);
    CHECK(sent_by(adapter, 0x4C9) == 0);  // DUNE's Goto: path, depth, yaw, speed, torque
    CHECK(sent_by(adapter, Loops::TORQUE) == 0);
    CHECK(sent_by(adapter, Loops::EXTERNAL | Loops::NO_OVERRIDE) == 5);
    CHECK(sent_by(adapter, Loops::EXTERNAL | Loops::SPEED) == 0);
    CHECK(sent_by(adapter, 0) == 5);
  }

  TEST_CASE("a vehicle that no longer says so for 5 s is steered again") {
    Typed<LauvVehicle> adapter;
    Counted nobody;
    adapter.reach(std::chrono::seconds(2), nobody);
    CHECK(sent_by(adapter, 0x4C9) == 0);
    for (const auto& [instant, sent] :
         {std::pair{std::chrono::milliseconds(6999), 0}, {std::chrono::milliseconds(7000), 5}}) {
      Counted counted;
      adapter.reach(instant, nobody);
      adapter.hand_over<&LauvVehicle::Out::actuation>({0.5, {}}, counted);
      CHECK(counted.sent == sent);
    }
  }

  TEST_CASE("one with entities, as a DUNE, is not steered before it has said whether it steers itself, or for 2 s") {
    using std::chrono::milliseconds;
    const auto sent_at = [](Typed<LauvVehicle>& adapter, Duration instant) {
      Counted counted, nobody;
      adapter.reach(instant, nobody);
      adapter.hand_over<&LauvVehicle::Out::actuation>({0.5, {}}, counted);
      return counted.sent;
    };
    const auto heard = [](Typed<LauvVehicle>& adapter, std::uint8_t entity) {
      const imc::Header from{.src = 0xD1, .src_ent = entity};
      const imc::Depth depth{1};
      messages::MessageRef message = messages::refer_to(depth);
      message.header = &from;
      adapter.receive(message);
    };
    Typed<LauvVehicle> silent, answering, plain;
    CHECK(sent_at(silent, milliseconds(500)) == 5);
    heard(silent, 30);
    CHECK(sent_at(silent, milliseconds(600)) == 0);
    heard(silent, 30);
    CHECK(sent_at(silent, milliseconds(2499)) == 0);
    CHECK(sent_at(silent, milliseconds(2500)) == 5);

    heard(answering, 30);
    CHECK(sent_at(answering, milliseconds(600)) == 0);
    CHECK(sent_by(answering, 0) == 5);

    heard(plain, 255);
    CHECK(sent_at(plain, milliseconds(600)) == 5);
  }

  TEST_CASE("loops that it switches on by ControlLoops are on at once, and off when its state says so") {
    using Loops = imc::CLoopsMask;
    Typed<LauvVehicle> adapter;
    const auto sent_after = [&](std::uint8_t enable, std::uint32_t mask) {
      adapter.receive(messages::refer_to(imc::ControlLoops{enable, mask}));
      Counted counted;
      adapter.hand_over<&LauvVehicle::Out::actuation>({0.5, {}}, counted);
      return counted.sent;
    };
    CHECK(sent_by(adapter, 0) == 5);
    CHECK(sent_after(imc::ControlLoops::Enable::DISABLE, Loops::DEPTH) == 5);
    CHECK(sent_after(imc::ControlLoops::Enable::ENABLE, Loops::EXTERNAL | Loops::NO_OVERRIDE) == 5);
    CHECK(sent_after(imc::ControlLoops::Enable::ENABLE, Loops::DEPTH) == 0);
    CHECK(sent_after(imc::ControlLoops::Enable::DISABLE, Loops::DEPTH) == 0);
    CHECK(sent_by(adapter, 0) == 5);
  }

  TEST_CASE("its fins go meanwhile where it wants them: none of them sticks") {
    Typed<LauvVehicle> adapter;
    const auto sent_of = [&](std::uint32_t loops) {
      sent_by(adapter, loops);
      adapter.receive(messages::refer_to(imc::ServoPosition{2, 0.25F}));
      tasks::Servos servos;
      CHECK(adapter.take<&LauvVehicle::In::servos>(servos));
      return servos.fins[2].commanded;
    };
    CHECK(sent_of(0) == 0.3);
    CHECK(sent_of(0x4C9) == 0.25);
    CHECK(sent_of(0) == 0.3);
  }

  TEST_CASE("of another vehicle at the link that is not known") {
    Typed<LauvVehicle> adapter;
    CHECK(sent_by(adapter, 0x4C9) == 0);
    adapter.peer_changed();
    Counted counted;
    adapter.hand_over<&LauvVehicle::Out::actuation>({0.5, {}}, counted);
    CHECK(counted.sent == 5);
  }
}
