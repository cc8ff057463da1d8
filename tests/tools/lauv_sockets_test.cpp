// Vehicle, graph and operator as three parties on real sockets: two commands as people run them, and a console.
#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <thread>

#include "distributers/messages/imc.h"
#include "tests/tools/process.h"
#include "tests/tools/socket_console.h"

namespace {
using namespace jarol;
namespace imc = messages::imc;
using tests::SocketConsole;
}  // namespace

TEST_SUITE("tools/lauv_sockets") {
  TEST_CASE("a console lists the vehicle, dives and turns it, steers it by hand and aborts; the vehicle is elsewhere") {
    const std::string plant = tests::free_port(SOCK_DGRAM), core = tests::free_port(SOCK_DGRAM),
                      operating = tests::free_port(SOCK_DGRAM);
    tests::Process vehicle("vehicle submarine --bare --link udp --listen " + plant + " --id 0x00D1");
    tests::Process graph(
        "run specs/exolauv_bare.yaml --profile lab --clock real --for 1h --set distributers.dune.link.listen=" + core +
        " --set distributers.dune.link.peer=127.0.0.1:" + plant +
        " --set distributers.neptus.link.listen=" + operating);
    using OpMode = imc::VehicleState::OpMode;
    SocketConsole console(operating);
    const auto& s = console.state;
    const auto is_in = [&](int op_mode) { return [&console, op_mode] { return console.op_mode == op_mode; }; };
    CHECK(console.say_until([&] { return !console.actions.empty(); },
                            imc::RemoteActionsRequest{imc::RemoteActionsRequest::Op::QUERY, ""}));
    CHECK(console.say_until(is_in(OpMode::SERVICE), imc::Heartbeat{}));
    CHECK(console.say_until(
        [&] { return s.u > 0.6F && s.psi > 0.15F && s.theta < -0.1F && console.op_mode == OpMode::EXTERNAL; },
        imc::DesiredZ{3, imc::ZUnits::DEPTH}, imc::DesiredHeading{1.5},
        imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS}));
    CHECK(console.say_until([&] { return s.r < -0.05F && console.op_mode == OpMode::MANEUVER; },
                            imc::RemoteActions{"Heading=-127;Thrust=64"}));
    CHECK(console.say_until(is_in(OpMode::ERROR), imc::Abort{}));
    CHECK(console.say_until(is_in(OpMode::SERVICE), imc::Heartbeat{}));
    CHECK(console.say_until([&] { return console.heartbeats > 1; }, imc::Heartbeat{}));
    CHECK(std::abs(s.lat - 0.718813) < 1e-5);
    graph.interrupt();
    CHECK(graph.end() == 130);
    CHECK(graph.output().find("  link        udp ") != std::string::npos);
    CHECK(graph.output().find("NO PACKET") == std::string::npos);
    vehicle.interrupt();
    CHECK(vehicle.end() == 130);
    CHECK(vehicle.output().find("NO PACKET") == std::string::npos);
  }

  TEST_CASE("of a vehicle that says nothing one is told after three seconds, and when it is heard") {
    const std::string plant = tests::free_port(SOCK_DGRAM), core = tests::free_port(SOCK_DGRAM);
    tests::Process graph("run specs/exolauv_bare.yaml --profile lab --clock real --for 1h --set " +
                         ("distributers.dune.link.listen=" + core) + " --set distributers.dune.link.peer=127.0.0.1:" +
                         plant + " --set distributers.neptus.link.listen=" + tests::free_port(SOCK_DGRAM));
    CHECK(graph.rest_of_line("note: nothing has come from the vehicle of 'dune' in ")
              .ends_with(" s; is it there? The run goes on, and hears it when it is"));
    tests::Process vehicle("vehicle submarine --bare --link udp --listen " + plant + " --id 0x00D1");
    CHECK(graph.rest_of_line("note: after ").ends_with(" s every vehicle is heard"));
    graph.interrupt();
    CHECK(graph.end() == 130);
    CHECK(graph.errors().find("nothing has come", graph.errors().find("every vehicle")) == std::string::npos);
    vehicle.interrupt();
    vehicle.end();
  }

  TEST_CASE("one that was never heard is brought to rest unseen, as is said; a second signal ends that") {
    tests::Process graph(
        "run specs/exolauv.yaml --clock real --for 1h --set 'distributers.dune.link={type: udp, peer: \"127.0.0.1:" +
        tests::free_port(SOCK_DGRAM) + "\"}'");
    CHECK(graph.says("note: nothing has come from the vehicle of 'dune' in "));
    graph.interrupt();
    CHECK(graph.says("note: nothing has come from the vehicle of 'dune', so that its rest can't be seen\n"));
    CHECK(graph.says("interrupt again to hand over the safe commands at once\n"));
    std::this_thread::sleep_for(std::chrono::milliseconds(700));  // sooner it is one that came twice
    graph.interrupt();
    CHECK(graph.end() == 3);  // as its vehicle was not there
    CHECK(graph.errors().find("error: nothing came from the vehicle of 'dune' in the whole run; is it there?\n") !=
          std::string::npos);
    CHECK(graph.errors().find(
              "error: whether the vehicle came to rest is not known: it was silent when a second signal came\n") !=
          std::string::npos);
  }

  TEST_CASE("two consoles at once steer one submarine; one leaves and comes again; who has no place is a stranger") {
    const std::string operating = tests::free_port(SOCK_DGRAM);
    tests::Process graph(
        "run specs/exolauv.yaml --profile console --clock real --json --for 1h --set "
        "distributers.neptus.link.peers=2 --set distributers.neptus.link.listen=" +
        operating);
    using OpMode = imc::VehicleState::OpMode;
    std::optional<SocketConsole> one(std::in_place, operating, 0x4001);
    SocketConsole other(operating, 0x4002);
    const imc::EntityList query{imc::EntityList::Op::QUERY, ""};
    for (SocketConsole* console : {&*one, &other})
      CHECK(
          console->say_until([&] { return !console->entities.empty() && console->op_mode == OpMode::SERVICE; }, query));
    // what one commands, both see; and the other's heading is added to its depth
    CHECK(one->say_until([&] { return one->state.depth > 0.3F && one->op_mode == OpMode::EXTERNAL; },
                         imc::DesiredZ{2, imc::ZUnits::DEPTH}, imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS}));
    CHECK(other.say_until([&] { return other.state.psi > 0.15F && other.op_mode == OpMode::EXTERNAL; },
                          imc::DesiredHeading{1.5}));
    CHECK(one->say_until([&] { return one->state.psi > 0.15F; }, imc::Heartbeat{}));
    {
      SocketConsole third(operating, 0x4003);
      third.say(imc::Abort{});
      const int before = other.heartbeats;
      CHECK(other.say_until([&] { return other.heartbeats > before + 1; }, imc::Heartbeat{}));
      CHECK(other.op_mode == OpMode::EXTERNAL);
      CHECK(third.heartbeats == 0);
    }
    one.reset();
    const int before = other.heartbeats;
    CHECK(other.say_until([&] { return other.heartbeats > before + 1; }, imc::Heartbeat{}));
    one.emplace(operating, 0x4001);
    CHECK(one->say_until([&] { return one->heartbeats > 1; }, imc::Heartbeat{}));
    CHECK(one->say_until([&] { return one->op_mode == OpMode::ERROR; }, imc::Abort{}));
    CHECK(other.say_until([&] { return other.op_mode == OpMode::SERVICE; }, imc::Heartbeat{}));
    graph.interrupt();
    CHECK(graph.end() == 130);
    const nlohmann::json link = graph.json()["links"][0];
    CHECK(link["heard"] == true);
    CHECK(link["counts"]["peers"] == 3);
    CHECK(link["counts"]["closed ports"] == 1);
    CHECK(link["counts"]["takeovers"] == 0);
    CHECK(link["peers"].size() == 3);
    CHECK(link["strangers"].size() == 1);
    CHECK(link["strangers"][0]["times"] == 1);
  }
}
