// Peers that are killed, come again, or vanish while the others go on: real processes on real sockets. All scenarios
// run at the same time, each test looks at the outcome of one.
// In one file: all scenarios start and kill the same processes.
#include <doctest/doctest.h>
#include <sys/socket.h>

#include <chrono>
#include <cmath>
#include <future>
#include <thread>

#include "distributers/links/link.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"
#include "tests/distributers/links/stream_proxy.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"
#include "tests/tools/terminal.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::Process;
using tests::Terminal;
namespace imc = messages::imc;
using nlohmann::json;

struct Outcome {
  json run, vehicle;  // of the last process of each sort
  int exit_code = -1;
  std::string errors;
};

const std::string diving = "time,setpoint.depth,setpoint.heading,setpoint.speed\n0,3,0deg,1.2\n60,3,0deg,1.2\n";
const std::string rising =
    "time,command.altitude,command.mode_switches,command.state_switches\n"
    "0,0,1,0\n0.5,0,1,1\n1,0,1,2\n3,0.7,1,2\n60,0.7,1,2\n";

const std::string waiting = "time,command.altitude\n0,0\n60,0\n";

// a sensor that reports the same for long is taken for stuck
const std::string noisy_helicopter = "vehicle helicopter --parameters specs/vehicles/helicopter.yaml";

class Scenarios {
 public:
  Scenarios()
      : dive_(folder_.write("dive.csv", diving)),
        rise_(folder_.write("rise.csv", rising)),
        wait_(folder_.write("wait.csv", waiting)),
        submarine_dies(start(&Scenarios::kill_submarine)),
        controller_dies(start(&Scenarios::kill_controller)),
        helicopter_dies(start(&Scenarios::kill_helicopter)),
        helicopter_dies_on_a_line(start(&Scenarios::kill_helicopter_on_a_line)),
        pilot_dies(start(&Scenarios::kill_pilot)),
        terminal_goes(start(&Scenarios::take_terminal)),
        console_goes(start(&Scenarios::take_console)) {}

 private:
  command::TemporaryFolder folder_;
  std::string dive_, rise_, wait_;

 public:
  std::shared_future<Outcome> submarine_dies, controller_dies, helicopter_dies, helicopter_dies_on_a_line, pilot_dies,
      terminal_goes, console_goes;

 private:
  std::shared_future<Outcome> start(Outcome (Scenarios::*scenario)() const) {
    return std::async(std::launch::async, [this, scenario] { return (this->*scenario)(); }).share();
  }

  static std::string submarine(const std::string& port, const std::string& more) {
    return "vehicle submarine --bare --link udp --listen " + port + " --id 209 --json " + more;
  }
  std::string submarine_control(const std::string& port, const std::string& more) const {
    return "run specs/exolauv_bare.yaml --set expect=nothing --set fault_limit=100% --clock real --json --profile dune "
           "--set distributers.neptus.link.file=" +
           dive_ + " --set distributers.dune.link.listen=0 --set distributers.dune.link.peer=" + port + " " + more;
  }
  std::string helicopter_control(const std::string& link, const std::string& more) const {
    return "run specs/javiator.yaml --set expect=nothing --set at_end=null --set fault_limit=100% --clock real --json "
           "--set "
           "distributers.terminal.link.file=" +
           rise_ + " --set 'distributers.robostix.link=" + link + "' " + more;
  }

  static Outcome outcome(Process& run, Process* vehicle) {
    Outcome all;
    all.exit_code = run.end();
    all.errors = run.errors();
    if (all.exit_code == 0) all.run = run.json();
    if (vehicle != nullptr && vehicle->end() <= 1) all.vehicle = vehicle->json();  // 1: it crashed
    return all;
  }

  Outcome kill_submarine() const {
    const std::string port = tests::free_port(SOCK_DGRAM);
    Process first(submarine(port, ""));
    if (!first.says("until Ctrl-C")) return {};
    Process run(submarine_control(port, "--for 10s"));
    std::this_thread::sleep_for(3s);
    first.kill();
    first.end();
    std::this_thread::sleep_for(3s);
    // it ends before the run does, which hands over the safe command then
    Process second(submarine(port, "--for 3500ms"));
    return outcome(run, &second);
  }

  Outcome kill_controller() const {
    const std::string port = tests::free_port(SOCK_DGRAM);
    Process vehicle(submarine(port, "--for 11s"));
    if (!vehicle.says("until Ctrl-C")) return {};
    {
      const Process first(submarine_control(port, "--for 60s"));
      std::this_thread::sleep_for(3s);
    }
    std::this_thread::sleep_for(3500ms);
    Process second(submarine_control(port, "--for 4s"));
    return outcome(second, &vehicle);
  }

  Outcome kill_helicopter() const {
    const std::string port = tests::free_port(SOCK_STREAM);
    return kill_helicopter(" --link tcp_server --listen " + port, "{type: tcp_client, peer: " + port + "}");
  }

  Outcome kill_helicopter_on_a_line() const {
    const tests::SerialProxy line({}, 0);
    return kill_helicopter(" --link serial --device " + line.name(0), "{type: serial, device: " + line.name(1) + "}");
  }

  Outcome kill_helicopter(const std::string& its_link, const std::string& link) const {
    const std::string helicopter = noisy_helicopter + " --json" + its_link;
    Process first(helicopter);
    if (!first.says("until Ctrl-C")) return {};
    Process run(helicopter_control(link, "--for 12s"));
    std::this_thread::sleep_for(7s);
    first.kill();
    first.end();
    std::this_thread::sleep_for(1s);
    Process second(helicopter + " --for 5s");
    return outcome(run, &second);
  }

  Outcome kill_pilot() const {
    const std::string port = tests::free_port(SOCK_DGRAM);
    Process vehicle(noisy_helicopter + " --link udp --json --for 12s --silence 1s --listen " + port);
    if (!vehicle.says("until Ctrl-C")) return {};
    const std::string link = "{type: udp, peer: \"127.0.0.1:" + port + "\"}";
    {
      const Process first(helicopter_control(link, "--for 60s --no-guardian"));
      std::this_thread::sleep_for(7s);
    }
    std::this_thread::sleep_for(1500ms);
    Process second(
        "run specs/javiator.yaml --set expect=nothing --set at_end=null --set fault_limit=100% --clock real --json "
        "--for "
        "2s --set "
        "'distributers.robostix.link=" +
        link + "' --set distributers.terminal.link.file=" + wait_);
    return outcome(second, &vehicle);
  }

  Outcome take_terminal() const {
    const std::string port = tests::free_port(SOCK_DGRAM);
    Process run(
        "run specs/javiator.yaml --set fault_limit=100% --clock real --json --profile terminal --for 12s --set "
        "distributers.terminal.link.listen=" +
        port);
    std::this_thread::sleep_for(1s);
    {
      Terminal terminal(std::stoi(port), Terminal::Over::udp);
      const auto fly = [&](int reports) {
        for (int i = 0; i < reports; ++i)
          if (!terminal.answer()) return;
      };
      fly(10);
      terminal.press(Terminal::switch_state);
      fly(10);
      terminal.press(Terminal::switch_state);
      fly(120);
      while (terminal.needles.altitude < 700) {
        terminal.needles.altitude = static_cast<std::int16_t>(terminal.needles.altitude + 7);
        fly(1);
      }
      fly(150);
    }
    return outcome(run, nullptr);
  }

  Outcome take_console() const {
    using namespace distributers;
    const std::string port = tests::free_port(SOCK_DGRAM);
    Process run(
        "run specs/exolauv.yaml --set fault_limit=100% --clock real --json --profile console --for 14s --set "
        "distributers.neptus.link.listen=" +
        port);
    std::this_thread::sleep_for(500ms);
    {
      Link console(std::make_unique<UdpTransport>(Address::parse("0"), Address::parse(port)), imc::message_set(),
                   {.input = {}, .output = {}, .header = {{"src", 0x4001}}});
      console.connect();
      for (int i = 0; i < 40; ++i) {
        console.send(messages::refer_to(imc::DesiredZ{3, imc::ZUnits::DEPTH}));
        console.send(messages::refer_to(imc::DesiredSpeed{1.2, imc::SpeedUnits::METERS_PS}));
        console.flush();
        std::this_thread::sleep_for(100ms);
      }
    }
    return outcome(run, nullptr);
  }
};

const Scenarios& scenarios() {
  static const Scenarios all;
  return all;
}

std::uint64_t count_of(const json& link, const std::string& name) { return link["counts"][name]; }
// Of one that was killed in flight and came back.
void check_landing(const Outcome& o) {
  INFO(o.errors);
  REQUIRE(o.exit_code == 0);
  MESSAGE("controller: " << o.run["outputs"]["to_terminal"].dump() << " " << o.run["links"][0].dump() << " "
                         << o.run["failsafe"].dump());
  MESSAGE("the second one: " << o.vehicle.dump());
  CHECK(o.run["outputs"]["to_terminal"]["cause"] == "answers_late");
  // the second one was never unlocked, and stands where it stood
  CHECK(o.vehicle["actuators"]["front"] == 0);
  CHECK(o.vehicle["state"]["z"] > -0.25);
}
double seconds(const json& ns) { return ns.get<double>() * 1e-9; }
}  // namespace

TEST_SUITE("tools/restarts") {
  TEST_CASE("a submarine that is killed gets the safe command, and is steered again when it comes back: UDP") {
    const Outcome o = scenarios().submarine_dies.get();
    INFO(o.errors);
    REQUIRE(o.exit_code == 0);
    const json& safe = o.run["failsafe"]["to_dune"];
    MESSAGE("to the submarine: " << safe.dump());
    MESSAGE("the second one: " << o.vehicle.dump());
    // from 1 s after the death on
    CHECK(safe["times"] >= 1);
    CHECK(safe["commands"] >= 25);
    CHECK(seconds(safe["last_ns"]) > 4.5);
    CHECK(seconds(safe["last_ns"]) < 8.5);
    CHECK(o.vehicle["state"]["u"] > 0.2);
    CHECK(o.vehicle["actuators"]["propeller"] > 50);
  }

  TEST_CASE("a submarine whose controller is killed stops its propeller, and obeys the next one: UDP") {
    const Outcome o = scenarios().controller_dies.get();
    INFO(o.errors);
    REQUIRE(o.exit_code == 0);
    MESSAGE(o.vehicle.dump());
    const json& peer = o.vehicle["peer"];
    CHECK(peer["silent"] >= 1);
    double longest = 0;
    json of;
    for (const json& silence : peer["silences"])
      if (const double time = seconds(silence["to_ns"]) - seconds(silence["from_ns"]); time > longest) {
        longest = time;
        of = silence;
      }
    CHECK(longest > 3);
    CHECK(of["actuators"]["propeller"] < 20);  // after the vehicle's own 2 s
    CHECK(of["state"]["u"] > 0);
    CHECK(count_of(o.vehicle["link"], "peers") >= 2);
    CHECK(count_of(o.run["links"][0], "packets in") > 100);
  }

  TEST_CASE("a helicopter that is killed is connected to again; its controller was landing: TCP") {
    const Outcome o = scenarios().helicopter_dies.get();
    check_landing(o);
    CHECK(count_of(o.run["links"][0], "peers") >= 2);
    CHECK(count_of(o.run["links"][0], "ends of stream") >= 1);
  }

  TEST_CASE("a helicopter that is killed is heard again when it comes back; its controller was landing: serial") {
    const Outcome o = scenarios().helicopter_dies_on_a_line.get();
    check_landing(o);
    CHECK(count_of(o.vehicle["link"], "packets in") > 100);
    CHECK(count_of(o.vehicle["link"], "packets out") > 100);
  }

  TEST_CASE("a helicopter whose controller is killed in flight is on the ground with motors off at the end: UDP") {
    const Outcome o = scenarios().pilot_dies.get();
    INFO(o.errors);
    REQUIRE(o.exit_code == 0);
    MESSAGE(o.vehicle.dump());
    bool flew_on = false;  // on the signals that it held
    for (const json& silence : o.vehicle["peer"]["silences"])
      flew_on = flew_on || (silence["actuators"]["front"] > 5000 && silence["state"]["u"] != 0.0);
    CHECK(flew_on);
    CHECK(count_of(o.vehicle["link"], "peers") >= 2);
    CHECK(o.vehicle["actuators"]["front"] < 100);
    CHECK(std::abs(o.vehicle["state"]["u"].get<double>()) < 0.01);
    CHECK(o.vehicle["state"]["z"] > -0.25);  // however it lies
    CHECK(o.run["outputs"]["to_robostix"]["unlocked"] == false);
  }

  TEST_CASE("a helicopter whose terminal vanishes lands") {
    const Outcome o = scenarios().terminal_goes.get();
    INFO(o.errors);
    REQUIRE(o.exit_code == 0);
    const json& reported = o.run["outputs"]["to_terminal"];
    MESSAGE(reported.dump());
    CHECK(reported["cause"] == "operator_lost");
    CHECK(reported["state"] == "ground");
    CHECK(std::abs(reported["altitude"].get<double>()) < 0.05);
  }

  TEST_CASE("a submarine whose console vanishes comes up") {
    const Outcome o = scenarios().console_goes.get();
    INFO(o.errors);
    REQUIRE(o.exit_code == 0);
    const json& reported = o.run["outputs"]["to_neptus"];
    MESSAGE(reported.dump());
    CHECK(reported["alarm"] == "operator_lost");
    CHECK(reported["pitch"] > 0.1);  // nose up
  }
}
