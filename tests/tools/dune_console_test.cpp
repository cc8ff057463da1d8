// A console's plan, flown by the shipped graph with a peer that speaks as DUNE does: three parties on real sockets.
#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <thread>

#include "distributers/lauv/entities.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/imc_entity.h"
#include "graph/math/geometry.h"
#include "tests/tools/lauv_plan.h"
#include "tests/tools/process.h"
#include "tests/tools/socket_console.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace imc = messages::imc;
using Clock = std::chrono::steady_clock;

// Stands before `jarol vehicle`: what that says comes from the entities of DUNE, as tests/data/dune-dive.packets has
// them, in DUNE's units. What DUNE has not is left out, and what it has beside, said.
class Dune {
 public:
  Dune(const std::string& vehicle, const std::string& own, const std::string& core)
      : vehicle_(tests::imc_over_udp("0", vehicle, 0x4001)), core_(tests::imc_over_udp(own, core, 0x00D1)) {
    thread_ = std::thread([this] {
      Calls translated([this](messages::MessageRef m) { translate(m); });
      Calls passed([this](messages::MessageRef m) { pass(m); });
      for (auto next = Clock::now(); !ended_; next += 2ms) {
        vehicle_->receive(translated);
        core_->receive(passed);
        vehicle_->flush();
        core_->flush();
        std::this_thread::sleep_until(next);
      }
    });
  }
  ~Dune() {
    ended_ = true;
    thread_.join();
  }

  std::atomic<bool> nose_is_wet{false};
  std::atomic<int> labels_asked{0};

 private:
  enum : std::uint8_t {
    ctd = 6,
    dvl,
    depth_sensor,
    altimeter = 10,
    echo_sounder,
    gps,
    ahrs = 15,
    tail = 17,
    nose,
    motor,
    servos
  };

  template <class Take>
  struct Calls : messages::Receiver {
    explicit Calls(Take t) : take(t) {}
    void receive(messages::MessageRef message) override { take(message); }
    Take take;
  };

  template <class M>
  void say(std::uint8_t entity, const M& message) {
    Calls to_core([this](messages::MessageRef m) { core_->send(m); });
    imc::send_from(entity, message, to_core);
  }
  // As they are, from that entity.
  template <class... M>
  bool says_from(std::uint8_t entity, messages::MessageRef message) {
    const auto say_if = [&](const auto* m) {
      if (m != nullptr) say(entity, *m);
      return m != nullptr;
    };
    return (say_if(message.as<M>()) || ...);
  }

  void translate(messages::MessageRef message) {
    if (says_from<imc::AngularVelocity, imc::EulerAngles>(ahrs, message) ||
        says_from<imc::WaterVelocity>(dvl, message) || says_from<imc::Rpm>(motor, message) ||
        says_from<imc::ServoPosition>(servos, message) || says_from<imc::GpsFix>(gps, message) ||
        says_from<imc::Conductivity>(ctd, message)) {
      if (const auto* angles = message.as<imc::EulerAngles>()) angles_ = *angles;
    } else if (const auto* depth = message.as<imc::Depth>()) {
      say(depth_sensor, *depth);
      say(ctd, imc::Depth{depth->value + 0.4F});  // its own, less exact
    } else if (const auto* pressure = message.as<imc::Pressure>()) {
      say(ctd, imc::Pressure{pressure->value / 1000});
    } else if (const auto* temperature = message.as<imc::Temperature>()) {
      if (Entities::sender_of(message) == Entities::nobody) say(ctd, *temperature);
    } else if (const auto* force = message.as<imc::Acceleration>()) {
      // without gravity in it
      const double level = std::cos(angles_.theta);
      imc::Acceleration own = *force;
      own.x -= gravity * std::sin(angles_.theta);
      own.y += gravity * level * std::sin(angles_.phi);
      own.z += gravity * level * std::cos(angles_.phi);
      say(ahrs, own);
    } else if (const auto* distance = message.as<imc::Distance>()) {
      say(altimeter, *distance);
      imc::Distance ahead = *distance;
      ahead.value = 29.5F;
      say(echo_sounder, ahead);
    } else if (const auto* state = message.as<imc::EntityState>()) {
      const auto number = Entities::sender_of(message);
      imc::EntityState own = *state;
      if (number == 1 && nose_is_wet) own.state = imc::EntityState::State::FAILURE;
      if (number == 1 || number == 2) say(number == 1 ? nose : tail, own);
    } else if (message.as<imc::SimulatedState>() != nullptr) {
      core_->send(message);
    }
  }

  void pass(messages::MessageRef message) {
    if (const auto* list = message.as<imc::EntityList>()) {
      if (list->op != imc::EntityList::Op::QUERY) return;
      ++labels_asked;
      say(0, imc::EntityList{imc::EntityList::Op::REPORT,
                             "Daemon=0;CTD=6;DVL=7;Depth Sensor=8;Altimeter=10;Echo Sounder=11;GPS=12;AHRS=15;"
                             "Leak Sensor - Tail=17;Leak Sensor - Nose=18;Motor=19;Servos=20"});
      say(0, imc::VehicleState{});
    } else {
      vehicle_->send({message.descriptor, message.value, nullptr});
    }
  }

  std::unique_ptr<Link> vehicle_, core_;
  imc::EulerAngles angles_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace

TEST_SUITE("tools/dune_console") {
  TEST_CASE(
      "DUNE's submarine flies a console's plan, guarded by its own instruments, and comes up when its nose leaks") {
    const std::string plant = tests::free_port(SOCK_DGRAM), own = tests::free_port(SOCK_DGRAM),
                      core = tests::free_port(SOCK_DGRAM), operating = tests::free_port(SOCK_DGRAM);
    tests::Process vehicle("vehicle submarine --parameters specs/vehicles/submarine_dune.yaml --link udp --listen " +
                           plant + " --id 0x00D1");
    Dune dune(plant, own, core);
    tests::Process graph(
        "run specs/exolauv.yaml --profile dune_console --clock real --json --for 1h --set "
        "distributers.dune.link.listen=" +
        core + " --set distributers.dune.link.peer=127.0.0.1:" + own +
        " --set distributers.neptus.link.listen=" + operating);
    tests::SocketConsole console(operating, 0x4002);
    const auto waits = [&](const auto& done) { return console.say_until(done, imc::Heartbeat{}); };
    using OpMode = imc::VehicleState::OpMode;
    using State = imc::PlanControlState::State;
    REQUIRE(waits([&] { return console.op_mode == OpMode::SERVICE && std::abs(console.state.lat) > 0; }));
    CHECK(console.state.lat == doctest::Approx(tests::origin_latitude).scale(0).epsilon(1e-5));
    CHECK(dune.labels_asked > 0);

    auto circles = tests::maneuver<imc::Loiter>(20, 15, 2);
    circles.radius = 12;
    circles.duration = 3600;
    console.say(
        tests::PlanOf("there").then("Goto1", tests::maneuver<imc::Goto>(20, 0, 2)).then("Loiter2", circles).start());
    REQUIRE(waits([&] { return console.plan.state == State::EXECUTING && console.plan.man_id == "Goto1"; }));
    REQUIRE(waits([&] { return console.plan.man_id == "Loiter2"; }));
    CHECK(waits([&] { return std::abs(console.state.depth - 2) < 0.1F; }));
    CHECK(console.op_mode == OpMode::MANEUVER);
    CHECK(console.deepest < 2.3F);

    dune.nose_is_wet = true;
    REQUIRE(waits([&] { return console.op_mode == OpMode::ERROR; }));
    CHECK(waits([&] { return console.state.depth < 0.3F; }));
    CHECK(console.plan.state != State::EXECUTING);
    CHECK(console.log_book ==
          "plan 'there' begins\n"
          "the vehicle comes up: leak\n"
          "plan 'there' ends: the vehicle comes up: leak\n");
    graph.interrupt();
    CHECK(graph.end() == 130);
    const nlohmann::json events = graph.json()["events"];
    REQUIRE(events.size() >= 1);
    CHECK(events[0]["values"]["alarm"] == "leak");
    vehicle.interrupt();
    CHECK(vehicle.end() == 130);
  }
}
