#include "vehicles/submarine_telemetry.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>

#include "vehicles/catalogue.h"
#include "vehicles/submarine.h"

namespace {
using namespace jarol;
using namespace jarol::vehicles;
namespace imc = messages::imc;

struct Peer : messages::Receiver {
  void receive(messages::MessageRef message) override {
    ++counts[std::string(message.form->name)];
    if (const auto* e = message.as<imc::EstimatedState>()) estimate = *e;
    if (const auto* s = message.as<imc::SimulatedState>()) truth = *s;
    if (const auto* p = message.as<imc::ServoPosition>()) servos[p->id] = p->value;
  }
  std::map<std::string, int> counts;
  imc::EstimatedState estimate;
  imc::SimulatedState truth;
  std::map<int, float> servos;
};
}  // namespace

TEST_SUITE("vehicles/submarine_telemetry") {
  TEST_CASE("in ten seconds a peer is told as often as DUNE tells") {
    Submarine submarine({});
    Peer peer;
    SubmarineTelemetry telemetry(submarine, peer);
    for (int i = 0; i < 1000; ++i) {
      submarine.step();
      submarine.sense(telemetry);
    }
    CHECK(peer.counts["SimulatedState"] == 1000);
    CHECK(peer.counts["ServoPosition"] == 4000);
    CHECK(peer.counts["EulerAngles"] == 1000);
    CHECK(peer.counts["AngularVelocity"] == 1000);
    CHECK(peer.counts["Acceleration"] == 1000);
    CHECK(peer.counts["EstimatedState"] == 200);
    CHECK(peer.counts["Rpm"] == 200);
    CHECK(peer.counts["Depth"] == 100);
    CHECK(peer.counts["Distance"] == 100);
    CHECK(peer.counts["GpsFix"] == 10);
    CHECK(peer.counts["Heartbeat"] == 10);
  }

  TEST_CASE("servo positions are where the fins are, and as commands move them") {
    Submarine submarine({});
    for (std::uint8_t i = 0; i < 4; ++i)
      submarine.accept(messages::refer_to(imc::ServoPosition{i, 0.05F * static_cast<float>(i)}));
    Peer peer;
    SubmarineTelemetry telemetry(submarine, peer);
    for (int i = 0; i < 50; ++i) submarine.step();
    submarine.sense(telemetry);
    const auto& fins = static_cast<const SubmarineOutputs*>(submarine.outputs())->actuators;
    CHECK(peer.servos[1] == static_cast<float>(fins.fin1));
    CHECK(peer.servos[3] == static_cast<float>(fins.fin3));
    CHECK(peer.servos[3] == doctest::Approx(0.15).epsilon(0.05));
  }

  TEST_CASE("the estimate is the true state; its velocity is over ground") {
    SubmarineParameters parameters;
    parameters.sea.current_east = 0.5;
    Submarine submarine(parameters);
    VehicleState state;
    state.z = 4;
    state.theta = 0.25;
    state.psi = 1;
    state.u = 1.5;
    submarine.place(state);
    Peer peer;
    SubmarineTelemetry telemetry(submarine, peer);
    submarine.sense(telemetry);
    CHECK(peer.estimate.lat == peer.truth.lat);
    CHECK(peer.estimate.depth == 4.0F);
    CHECK(peer.estimate.theta == 0.25F);
    CHECK(peer.estimate.vx == doctest::Approx(1.5 * std::cos(0.25) * std::cos(1.0)));
    CHECK(peer.estimate.vy == doctest::Approx(1.5 * std::cos(0.25) * std::sin(1.0) + 0.5));
    CHECK(peer.estimate.vz == doctest::Approx(-1.5 * std::sin(0.25)));
    CHECK(peer.estimate.alt == -1.0F);
  }
}
