// Vehicles flown over links that lose, double, delay and reorder packets: what is lost is counted, all counts add up,
// and the goals are reached all the same.
#include <doctest/doctest.h>
#include <sys/socket.h>

#include <chrono>
#include <fstream>
#include <future>
#include <sstream>
#include <thread>

#include "tests/distributers/links/lossy_proxy.h"
#include "tests/distributers/links/stream_proxy.h"
#include "tests/how_many.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using distributers::Address;
using nlohmann::json;
using tests::Process;
using tests::ProxyCounts;

constexpr tests::Disturbance bad_network{
    .loss = 0.1, .duplication = 0.05, .reordering = 0.05, .delay = 8ms, .held = 30ms};
constexpr tests::Disturbance bad_line{.loss = 0.01, .duplication = 0.005, .damage = 0.01, .delay = 500us};
// TCP loses nothing; it cuts up and holds up
constexpr tests::Disturbance bad_connection{.delay = 1ms, .longest_piece = 8};

struct Outcome {
  int exit_code = -1;
  std::string errors;
  json run, vehicle;
  ProxyCounts to_vehicle, from_vehicle;
};

const std::string dive = "time,setpoint.depth,setpoint.heading,setpoint.speed\n0,3,0deg,1.2\n90,3,0deg,1.2\n";
// up to half a metre and down again
const std::string hop =
    "time,command.altitude,command.mode_switches,command.state_switches\n"
    "0,0,1,0\n0.5,0,1,1\n1,0,1,2\n3,0.5,1,2\n8,0.5,1,3\n90,0.5,1,3\n";

// By itself the graph takes three periods without the IMU for its loss.
const std::string patience = " --set tasks.filter.parameters.imu_patience=0.2";

// The vehicle for so many seconds, and the graph from a little later until after its end. Nothing is let through in the
// vehicle's last second, so that all that was let through has arrived.
template <class Proxy>
Outcome fly(Proxy& proxy, const std::string& vehicle_arguments, const std::string& run_arguments, int seconds) {
  Outcome o;
  Process vehicle("vehicle " + vehicle_arguments + " --json --for " + std::to_string(seconds) + "s");
  if (!vehicle.says("until Ctrl-C")) {
    o.errors = vehicle.errors();
    return o;
  }
  Process run("run " + run_arguments + " --clock real --json --for " + std::to_string(seconds + 2) + "s");
  std::this_thread::sleep_for(std::chrono::seconds(seconds) - 1s);
  proxy.close(true);
  vehicle.end();
  o.exit_code = run.end();
  o.errors = vehicle.errors() + run.errors();
  if (o.exit_code == 0) o.run = run.json();
  o.vehicle = vehicle.json();
  return o;
}

class Flights {
 public:
  Flights() : dive_(folder_.write("dive.csv", dive)), hop_(folder_.write("hop.csv", hop)) {
    submarine = std::async(std::launch::async, [this] { return submarine_over_udp(); }).share();
    hasty = std::async(std::launch::async, [this] { return helicopter_over_udp("hasty.csv", ""); }).share();
    helicopter = std::async(std::launch::async, [this] { return helicopter_over_udp("udp.csv", patience); }).share();
    on_a_line = std::async(std::launch::async, [this] { return helicopter_on_a_line(); }).share();
    over_tcp = std::async(std::launch::async, [this] { return helicopter_over_tcp(); }).share();
  }
  std::string trace(const std::string& name) const { return folder_ / name; }

 private:
  command::TemporaryFolder folder_;
  std::string dive_, hop_;

 public:
  std::shared_future<Outcome> submarine, helicopter, hasty, on_a_line, over_tcp;

 private:
  Outcome submarine_over_udp() const {
    const std::string port = tests::free_port(SOCK_DGRAM);
    tests::UdpProxy proxy(Address::parse(port), bad_network, 1);
    Outcome o = fly(proxy, "submarine --bare --id 209 --link udp --listen " + port,
                    "specs/exolauv_bare.yaml --set expect=nothing --set fault_limit=100% --profile dune --set "
                    "distributers.dune.link.listen=0 "
                    "--set distributers.dune.link.peer=" +
                        std::to_string(proxy.port()) + " --set distributers.neptus.link.file=" + dive_,
                    tests::is_full() ? 40 : 11);
    o.to_vehicle = proxy.to_target();
    o.from_vehicle = proxy.from_target();
    return o;
  }

  std::string helicopter_graph(const std::string& link, const std::string& traced) const {
    return "specs/javiator.yaml --set expect=nothing --set at_end=null --set fault_limit=100% --set "
           "'distributers.robostix.link=" +
           link + "' --trace " + (folder_ / traced) +
           " --set distributers.terminal.link.file=" + (tests::is_full() ? "missions/hover.csv" : hop_);
  }

  Outcome helicopter_over_udp(const std::string& traced, const std::string& more) const {
    const std::string port = tests::free_port(SOCK_DGRAM);
    tests::UdpProxy proxy(Address::parse(port), bad_network, 2);
    Outcome o = fly(proxy, "helicopter --parameters specs/vehicles/helicopter.yaml --link udp --listen " + port,
                    helicopter_graph("{type: udp, peer: " + std::to_string(proxy.port()) + "}", traced) + more,
                    tests::is_full() ? 38 : 14);
    o.to_vehicle = proxy.to_target();
    o.from_vehicle = proxy.from_target();
    return o;
  }

  Outcome helicopter_on_a_line() const {
    tests::SerialProxy proxy(bad_line, 3);
    Outcome o =
        fly(proxy, "helicopter --parameters specs/vehicles/helicopter.yaml --link serial --device " + proxy.name(0),
            helicopter_graph("{type: serial, device: " + proxy.name(1) + "}", "serial.csv") + patience,
            tests::is_full() ? 38 : 14);
    o.to_vehicle = proxy.from(1);
    o.from_vehicle = proxy.from(0);
    return o;
  }

  Outcome helicopter_over_tcp() const {
    const std::string port = tests::free_port(SOCK_STREAM);
    tests::TcpProxy proxy(Address::parse(port), bad_connection, 4);
    Outcome o = fly(proxy, "helicopter --parameters specs/vehicles/helicopter.yaml --link tcp_server --listen " + port,
                    helicopter_graph("{type: tcp_client, peer: " + std::to_string(proxy.port()) + "}", "tcp.csv"),
                    tests::is_full() ? 38 : 14);
    o.to_vehicle = proxy.from(0);
    o.from_vehicle = proxy.from(1);
    return o;
  }
};

const Flights& flights() {
  static const Flights all;
  return all;
}

const json& link_of(const json& run) { return run.contains("links") ? run["links"][0] : run["link"]; }
std::uint64_t count_of(const json& run, const std::string& name) { return link_of(run)["counts"][name]; }

std::uint64_t flawed(const json& reported) {
  std::uint64_t sum = 0;
  for (const char* why : {"garbage", "truncated", "oversized", "bad checksum", "unknown id", "bad payload"})
    sum += count_of(reported, std::string("dropped: ") + why);
  return sum;
}

void report(const std::string& what, const ProxyCounts& c) {
  MESSAGE(what << ": " << c.in << " in, " << c.lost << " lost, " << c.duplicated << " doubled, " << c.reordered
               << " reordered, " << c.damaged << " damaged, " << c.out << " out");
}

// Sent = received + lost - doubled, on either way.
void check_datagrams(const Outcome& o) {
  report("to the vehicle", o.to_vehicle);
  report("from the vehicle", o.from_vehicle);
  CHECK(count_of(o.run, "packets out") == o.to_vehicle.in);
  CHECK(count_of(o.vehicle, "packets out") == o.from_vehicle.in);
  for (const ProxyCounts* c : {&o.to_vehicle, &o.from_vehicle}) {
    CHECK(c->in + c->duplicated == c->lost + c->out);
    CHECK(c->lost > c->in / 20);
    CHECK(c->duplicated > 0);
    CHECK(c->reordered > 0);
  }
  CHECK(count_of(o.vehicle, "packets in") == o.to_vehicle.out);
  CHECK(count_of(o.run, "packets in") == o.from_vehicle.out);
  CHECK(flawed(o.vehicle) + flawed(o.run) == 0);
}

// The greatest number in a column of a trace.
double highest_of(const std::string& trace, const std::string& column) {
  std::ifstream file(trace);
  std::string line, cell;
  std::getline(file, line);
  std::istringstream titles(line);
  std::size_t index = 0;
  while (std::getline(titles, cell, ',') && cell != column) ++index;
  REQUIRE(cell == column);
  double highest = 0;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    for (std::size_t i = 0; i <= index; ++i) std::getline(cells, cell, ',');
    if (!cell.empty()) highest = std::max(highest, std::stod(cell));
  }
  return highest;
}

// It has been up there, and is down again where it should be, upright, for nothing but the operator's key.
void check_hop(const Outcome& o, const std::string& trace) {
  const json &state = o.vehicle["state"], &reported = o.run["outputs"]["to_terminal"];
  MESSAGE("ended at " << state.dump() << ", reported " << reported["state"].dump() << " " << reported["cause"].dump());
  const double highest = highest_of(trace, "to_terminal.altitude");
  MESSAGE("highest " << highest << " m");
  CHECK(highest > (tests::is_full() ? 0.9 : 0.3));
  CHECK(highest < 1.5);
  CHECK(std::abs(state["phi"].get<double>()) < 0.05);
  CHECK(std::abs(state["theta"].get<double>()) < 0.05);
  CHECK(std::abs(state["x"].get<double>()) < 0.3);
  CHECK(std::abs(state["y"].get<double>() - (tests::is_full() ? 3 : 0)) < 0.3);
  CHECK(o.vehicle["actuators"]["front"] < 3000);
}
}  // namespace

TEST_SUITE("tools/lossy") {
  TEST_CASE("a submarine over UDP that loses a tenth of all packets comes to its depth") {
    const Outcome o = flights().submarine.get();
    INFO(o.errors);
    REQUIRE(o.exit_code == 0);
    check_datagrams(o);
    // packets of one step may have one stamp
    for (const auto& [at, c] : {std::pair(&o.vehicle, &o.to_vehicle), std::pair(&o.run, &o.from_vehicle)}) {
      MESSAGE(count_of(*at, "late") << " late");
      CHECK(count_of(*at, "late") <= c->reordered);
      CHECK(count_of(*at, "late") > c->reordered / 2);
    }
    const json& state = o.vehicle["state"];
    MESSAGE("ended at " << state.dump());
    const double depth = state["z"];
    if (tests::is_full()) {
      CHECK(depth == doctest::Approx(3).scale(0).epsilon(0.05));
      CHECK(state["u"].get<double>() == doctest::Approx(1.2).scale(0).epsilon(0.05));
    } else {
      CHECK(depth > 1);
    }
  }

  TEST_CASE("a helicopter over UDP that loses a tenth of all packets flies its mission and lands") {
    const Outcome o = flights().helicopter.get();
    INFO(o.errors);
    REQUIRE(o.exit_code == 0);
    check_datagrams(o);
    check_hop(o, flights().trace("udp.csv"));
  }

  TEST_CASE(
      "a helicopter over the same UDP that takes a short silence of its IMU for a loss is on the ground at the end, "
      "upright") {
    const Outcome o = flights().hasty.get();
    INFO(o.errors);
    REQUIRE(o.exit_code == 0);
    check_datagrams(o);
    const json &state = o.vehicle["state"], &reported = o.run["outputs"]["to_terminal"];
    MESSAGE("ended at " << state.dump() << ", reported " << reported.dump());
    MESSAGE("highest " << highest_of(flights().trace("hasty.csv"), "to_terminal.altitude") << " m");
    CHECK(reported["state"] == "ground");
    CHECK(std::abs(state["phi"].get<double>()) < 0.1);
    CHECK(std::abs(state["theta"].get<double>()) < 0.1);
    CHECK(state["z"] > -0.3);
  }

  TEST_CASE("a helicopter over TCP that cuts its packets up and holds the pieces up flies its mission and lands") {
    const Outcome o = flights().over_tcp.get();
    INFO(o.errors);
    REQUIRE(o.exit_code == 0);
    report("bytes to the vehicle", o.to_vehicle);
    report("bytes from the vehicle", o.from_vehicle);
    // but for a few packets of 16 bytes into a connection that the vehicle has just ended
    CHECK(count_of(o.run, "bytes out") >= o.to_vehicle.in);
    CHECK(count_of(o.run, "bytes out") <= o.to_vehicle.in + 4 * 16);
    CHECK(count_of(o.vehicle, "bytes out") == o.from_vehicle.in);
    CHECK(count_of(o.vehicle, "bytes in") == o.to_vehicle.out);
    CHECK(count_of(o.run, "bytes in") == o.from_vehicle.out);
    CHECK(flawed(o.vehicle) + flawed(o.run) == 0);
    check_hop(o, flights().trace("tcp.csv"));
  }

  TEST_CASE("a helicopter on a serial line that loses, doubles and damages bytes flies its mission and lands") {
    const Outcome o = flights().on_a_line.get();
    INFO(o.errors);
    REQUIRE(o.exit_code == 0);
    report("bytes to the vehicle", o.to_vehicle);
    report("bytes from the vehicle", o.from_vehicle);
    CHECK(count_of(o.run, "bytes out") == o.to_vehicle.in);
    CHECK(count_of(o.vehicle, "bytes out") == o.from_vehicle.in);
    // the begin of a packet may be left
    constexpr std::uint64_t left = 160;
    for (const auto& [at, c] : {std::pair(&o.vehicle, &o.to_vehicle), std::pair(&o.run, &o.from_vehicle)}) {
      const std::uint64_t out = c->in + c->duplicated - c->lost,
                          in = count_of(*at, "bytes in") + count_of(*at, "bytes dropped");
      CHECK(c->lost > 0);
      CHECK(in <= out);
      CHECK(out - in <= left);
      const auto good = static_cast<double>(count_of(*at, "packets in")), bad = static_cast<double>(flawed(*at));
      MESSAGE(bad << " packets of " << good + bad << " damaged");
      CHECK(bad > 0.03 * (good + bad));
    }
    check_hop(o, flights().trace("serial.csv"));
  }
}
