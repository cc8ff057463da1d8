#include "vehicles/submarine/telemetry.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>

#include "graph/math/geometry.h"
#include "vehicles/catalogue.h"
#include "vehicles/submarine/submarine.h"

namespace {
using namespace jarol;
using namespace jarol::vehicles;
namespace imc = messages::imc;

struct Peer : messages::Receiver {
  void receive(messages::MessageRef message) override {
    ++counts[std::string(message.descriptor->name)];
    if (const auto* e = message.as<imc::EstimatedState>()) estimate = *e;
    if (const auto* s = message.as<imc::SimulatedState>()) truth = *s;
    if (const auto* g = message.as<imc::GroundVelocity>()) ground = *g;
    if (const auto* v = message.as<imc::EstimatedStreamVelocity>()) stream = *v;
    if (const auto* p = message.as<imc::ServoPosition>()) servos[p->id] = p->value;
  }
  std::map<std::string, int> counts;
  imc::EstimatedState estimate;
  imc::SimulatedState truth;
  imc::GroundVelocity ground;
  imc::EstimatedStreamVelocity stream;
  std::map<int, float> servos;
};
}  // namespace

TEST_SUITE("vehicles/submarine_telemetry") {
  TEST_CASE("it announces where it lies, and the address at which it is reached") {
    SubmarineParameters parameters;
    Submarine submarine(parameters);
    VehicleState state = submarine.state();
    state.x = 1000;
    state.y = -2000;
    state.z = 3;
    submarine.place(state);
    const messages::Message message = announcement_of(submarine, "udp://127.0.0.1:6002");
    const auto* announce = message.as<imc::Announce>();
    REQUIRE(announce != nullptr);
    CHECK(announce->sys_name == "lauv-simulator-1");
    CHECK(announce->sys_type == imc::SystemType::UUV);
    CHECK(announce->services == "imc+info://0.0.0.0/version/5.4.31;imc+udp://127.0.0.1:6002/");
    // a degree of latitude has 111057.5 m here, one of longitude 83901.2 m, by the usual series for WGS-84
    CHECK((announce->lat - parameters.sea.latitude) / degree ==
          doctest::Approx(1000 / 111057.5).epsilon(1e-4).scale(0));
    CHECK((announce->lon - parameters.sea.longitude) / degree ==
          doctest::Approx(-2000 / 83901.2).epsilon(1e-4).scale(0));
  }

  TEST_CASE("in each of ten seconds a peer is sent reports as often as DUNE sends them, and nothing else") {
    SubmarineParameters parameters;
    parameters.sea.beacons.reach = 0;  // there are none where DUNE's simulator is
    Submarine submarine(parameters);
    Peer peer;
    SubmarineTelemetry telemetry(peer);
    for (int second = 0; second < 10; ++second) {
      CAPTURE(second);
      peer.counts.clear();
      for (int i = 0; i < 100; ++i) {
        submarine.sense(telemetry);
        submarine.step();
      }
      CHECK(peer.counts == std::map<std::string, int>{{"ServoPosition", 400},
                                                      {"SimulatedState", 100},
                                                      {"EulerAngles", 100},
                                                      {"AngularVelocity", 100},
                                                      {"Acceleration", 100},
                                                      {"EstimatedState", 20},
                                                      {"Rpm", 20},
                                                      {"Depth", 16},
                                                      {"Distance", 10},
                                                      {"SoundSpeed", 8},
                                                      {"Temperature", 7 + 4},
                                                      {"Conductivity", 6},
                                                      {"Pressure", 6},
                                                      {"Salinity", 6},
                                                      {"WaterVelocity", 5},
                                                      {"GroundVelocity", 5},
                                                      {"GpsFix", 1},
                                                      {"EstimatedStreamVelocity", 1},
                                                      {"Heartbeat", 1},
                                                      // DUNE's 30 entities send one each
                                                      {"EntityState", 4},
                                                      {"EntityList", 1},
                                                      {"VehicleState", 1},
                                                      // of the battery, which DUNE's simulator has not
                                                      {"Voltage", 1},
                                                      {"Current", 1}});
    }
  }

  TEST_CASE("a sensor that reports no more is silent soon, whatever its rate") {
    SubmarineParameters parameters;
    parameters.sensors.depth.failure = {.kind = FailureKind::lost, .at = 2};
    Submarine submarine(parameters);
    Peer peer;
    SubmarineTelemetry telemetry(peer);
    for (int i = 0; i < 500; ++i) {
      submarine.sense(telemetry);
      submarine.step();
    }
    CHECK(peer.counts["Depth"] == 32);
    CHECK(peer.counts["Pressure"] == 30);
  }

  TEST_CASE("velocity over ground is that through the water and the current, along the body's axes") {
    SubmarineParameters parameters;
    parameters.sea.current_north = 0.25;
    parameters.sea.current_east = 0.5;
    Submarine submarine(parameters);
    VehicleState state;
    state.z = 4;
    state.psi = 1;
    state.u = 1.5;
    submarine.place(state);
    Peer peer;
    SubmarineTelemetry telemetry(peer);
    for (int i = 0; i < 100; ++i) submarine.sense(telemetry);
    CHECK(peer.ground.validity == 7);
    CHECK(peer.ground.x == doctest::Approx(1.5 + 0.25 * std::cos(1.0) + 0.5 * std::sin(1.0)));
    CHECK(peer.ground.y == doctest::Approx(0.5 * std::cos(1.0) - 0.25 * std::sin(1.0)));
    CHECK(peer.ground.z == 0);
    CHECK(peer.stream.x == 0.25);
    CHECK(peer.stream.y == 0.5);
  }

  TEST_CASE("servo positions are where the fins are, and as commands move them") {
    Submarine submarine({});
    for (std::uint8_t i = 0; i < 4; ++i)
      submarine.accept(messages::refer_to(imc::ServoPosition{i, 0.05F * static_cast<float>(i)}));
    Peer peer;
    SubmarineTelemetry telemetry(peer);
    for (int i = 0; i < 50; ++i) submarine.step();
    submarine.sense(telemetry);
    const auto& fins = static_cast<const SubmarineOutputs*>(submarine.outputs())->actuators;
    CHECK(peer.servos[1] == static_cast<float>(fins.fin1));
    CHECK(peer.servos[3] == static_cast<float>(fins.fin3));
    CHECK(peer.servos[3] == doctest::Approx(0.15).scale(0).epsilon(0.05));
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
    SubmarineTelemetry telemetry(peer);
    for (int i = 0; i < 5; ++i) submarine.sense(telemetry);
    CHECK(peer.estimate.lat == peer.truth.lat);
    CHECK(peer.estimate.depth == 4.0F);
    CHECK(peer.estimate.theta == 0.25F);
    CHECK(peer.estimate.vx == doctest::Approx(1.5 * std::cos(0.25) * std::cos(1.0)));
    CHECK(peer.estimate.vy == doctest::Approx(1.5 * std::cos(0.25) * std::sin(1.0) + 0.5));
    CHECK(peer.estimate.vz == doctest::Approx(-1.5 * std::sin(0.25)));
    CHECK(peer.estimate.alt == -1.0F);
  }
}
