// Vehicle, graph and operator as three parties on real sockets: two commands as people run them, and a console.
#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "distributers/links/link.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace imc = messages::imc;
using Clock = std::chrono::steady_clock;

std::string free_port() {
  const Descriptor probe(socket(AF_INET, SOCK_DGRAM, 0));
  const Address any = Address::parse("0");
  REQUIRE(bind(probe.get(), any.get(), any.size()) == 0);
  return std::to_string(port_of(probe));
}

// A command that runs beside the test, to its end.
class Running {
 public:
  explicit Running(const std::string& arguments)
      : thread_([this, arguments] { result_ = command::jarol(arguments); }) {}
  ~Running() { end(); }
  const command::Result& end() {
    if (thread_.joinable()) thread_.join();
    return result_;
  }

 private:
  command::Result result_;
  std::thread thread_;
};

class Console : public messages::Receiver {
 public:
  explicit Console(const std::string& port)
      : link_(std::make_unique<UdpTransport>(Address::parse("0"), Address::parse(port)), imc::message_set(),
              {.input = {PortKind::push, 256}, .output = {}, .header = {{"src", 0x4001}}}) {
    link_.connect();
  }

  template <class M>
  void say(const M& message) {
    link_.send(messages::refer_to(message));
    link_.flush();
  }
  void receive(messages::MessageRef message) override {
    if (const auto* s = message.as<imc::EstimatedState>()) state = *s;
    if (const auto* v = message.as<imc::VehicleState>()) op_mode = v->op_mode;
    if (const auto* a = message.as<imc::RemoteActionsRequest>()) actions = std::string(a->actions);
    if (message.as<imc::Heartbeat>() != nullptr) ++heartbeats;
  }
  // Says it every 100 ms, as a console does, until that is so.
  template <class M, class Done>
  bool say_until(const M& message, const Done& done, std::chrono::seconds patience = 20s) {
    for (const auto end = Clock::now() + patience; Clock::now() < end; std::this_thread::sleep_for(100ms)) {
      say(message);
      link_.receive(*this);
      if (done()) return true;
    }
    return false;
  }

  imc::EstimatedState state;
  int op_mode = -1;
  int heartbeats = 0;
  std::string actions;

 private:
  Link link_;
};
}  // namespace

TEST_SUITE("tools/lauv_sockets") {
  TEST_CASE("a console lists the vehicle, dives and turns it, steers it by hand and aborts; the vehicle is elsewhere") {
    const std::string plant = free_port(), core = free_port(), operating = free_port();
    Running vehicle("vehicle submarine --bare --link udp --listen " + plant + " --id 0x00D1 --for 12s");
    Running graph(
        "run specs/exolauv_bare.yaml --profile lab --clock real --for 11s --set distributers.dune.link.listen=" + core +
        " --set distributers.dune.link.peer=127.0.0.1:" + plant +
        " --set distributers.neptus.link.listen=" + operating);
    Console console(operating);
    const auto& s = console.state;
    CHECK(console.say_until(imc::RemoteActionsRequest{imc::RemoteActionsRequest::Op::QUERY, ""},
                            [&] { return !console.actions.empty(); }));
    CHECK(console.say_until(imc::Heartbeat{}, [&] { return console.op_mode == imc::VehicleState::OpMode::SERVICE; }));
    console.say(imc::DesiredZ{3, imc::ZUnits::DEPTH});
    console.say(imc::DesiredHeading{1.5});
    CHECK(console.say_until(imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS},
                            [&] { return s.u > 0.6F && s.psi > 0.15F && s.theta < -0.1F; }));
    CHECK(console.op_mode == imc::VehicleState::OpMode::EXTERNAL);
    CHECK(console.say_until(imc::RemoteActions{"Heading=-127;Thrust=64"}, [&] { return s.r < -0.05F; }));
    CHECK(console.op_mode == imc::VehicleState::OpMode::MANEUVER);
    CHECK(console.say_until(imc::Abort{}, [&] { return console.op_mode == imc::VehicleState::OpMode::ERROR; }));
    CHECK(console.say_until(imc::Heartbeat{}, [&] { return console.op_mode == imc::VehicleState::OpMode::SERVICE; }));
    CHECK(console.heartbeats > 1);
    CHECK(std::abs(s.lat - 0.718813) < 1e-5);
    INFO(graph.end().output);
    CHECK(graph.end().exit_code == 0);
    CHECK(graph.end().output.find("NO PACKET") == std::string::npos);
    INFO(vehicle.end().output);
    CHECK(vehicle.end().exit_code == 0);
    CHECK(vehicle.end().output.find("NO PACKET") == std::string::npos);
  }
}
