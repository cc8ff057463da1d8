// The four applications, JAviator and LAUV as exotasks and on threads, with the vehicle in process and as another
// process: their whole missions, and nothing after them, in real time, all at once.
#include <doctest/doctest.h>
#include <sys/socket.h>

#include <cmath>
#include <future>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/tools/process.h"

namespace {
using namespace jarol;
using nlohmann::json;
using tests::Process;

struct Outcome {
  int exit_code = -1;
  std::string errors;
  json run;
};

Outcome outcome(const std::string& arguments) {
  Process run("run " + arguments + " --clock real --json --set fault_limit=100% --set at_end=null");
  Outcome o{run.end(), run.errors(), {}};
  if (o.exit_code == 0) o.run = run.json();
  return o;
}

// The vehicle is there as long as the mission lasts.
Outcome outcome(const std::string& vehicle_arguments, const std::string& arguments) {
  Process vehicle("vehicle " + vehicle_arguments);
  if (!vehicle.says("until Ctrl-C")) return {-1, vehicle.errors(), {}};
  return outcome(arguments);
}

Outcome submarine(const std::string& where, const std::string& threads) {
  const std::string graph = "specs/exolauv.yaml" + threads;
  if (where == "in process") return outcome(graph);
  const std::string port = tests::free_port(SOCK_DGRAM);
  return outcome("submarine --link udp --id 0x00D1 --listen " + port,
                 graph + " --set 'distributers.dune.link={type: udp, peer: " + port + ", id: 16385, source: 0x00D1}'");
}

Outcome helicopter(const std::string& where, const std::string& threads) {
  const std::string graph = "specs/javiator.yaml" + threads;
  if (where == "in process") return outcome(graph);
  const bool udp = where == "UDP";
  const std::string at = "\"[::1]:" + tests::free_port(udp ? SOCK_DGRAM : SOCK_STREAM) + "\"";
  return outcome(
      "helicopter --parameters specs/vehicles/helicopter.yaml --listen " + at + " --link " + (udp ? "udp" : "tcp"),
      graph + " --set 'distributers.robostix.link={type: " + (udp ? "udp" : "tcp_client") + ", peer: " + at + "}'");
}

using Key = std::tuple<std::string, std::string>;  // where the vehicle is, and what runs the tasks
const std::vector<std::string> concurrencies{"", " --concurrency threads"};

class Missions {
 public:
  Missions() {
    for (const std::string& threads : concurrencies) {
      for (const char* where : {"in process", "UDP"})
        submarines[{where, threads}] = std::async(std::launch::async, submarine, where, threads).share();
      for (const char* where : {"in process", "UDP", "TCP"})
        helicopters[{where, threads}] = std::async(std::launch::async, helicopter, where, threads).share();
    }
  }
  std::map<Key, std::shared_future<Outcome>> submarines, helicopters;
};

const Missions& missions() {
  static const Missions all;
  return all;
}

// Of the link to the vehicle, if there is one: all that came was good, and most of it came.
void check_link(const Outcome& o, const std::string& where, double packets_in) {
  if (where == "in process") {
    CHECK_FALSE(o.run.contains("links"));
    return;
  }
  const json& counts = o.run["links"][0]["counts"];
  MESSAGE(where << ": " << o.run["links"][0]["link"].dump() << " " << counts["packets in"] << " packets in, "
                << counts["packets out"] << " out, " << counts["late"] << " late");
  CHECK(counts["packets in"] > packets_in);
  CHECK(counts["bytes dropped"] == 0);
  CHECK(counts["dropped: stranger"] == 0);
}
}  // namespace

TEST_SUITE("tools/applications") {
  TEST_CASE("the LAUV dives to 3 m, turns by 90 degrees and keeps 1.2 m/s") {
    for (const auto& [key, mission] : missions().submarines) {
      const auto& [where, threads] = key;
      CAPTURE(where);
      CAPTURE(threads);
      const Outcome o = mission.get();
      INFO(o.errors);
      REQUIRE(o.exit_code == 0);
      const json& reported = o.run["outputs"]["to_neptus"];
      MESSAGE(where << threads << ": " << reported.dump());
      CHECK(std::abs(reported["depth"].get<double>() - 3) < 0.05);
      CHECK(std::abs(reported["heading"].get<double>() - std::numbers::pi / 2) < 0.035);
      CHECK(std::abs(reported["speed"].get<double>() - 1.2) < 0.05);
      CHECK(reported["alarm"] == "none");
      check_link(o, where, 80'000);
    }
  }

  TEST_CASE("the JAviator takes off, flies to 3 m in the east and lands; over IPv6, where the vehicle is elsewhere") {
    for (const auto& [key, mission] : missions().helicopters) {
      const auto& [where, threads] = key;
      CAPTURE(where);
      CAPTURE(threads);
      const Outcome o = mission.get();
      INFO(o.errors);
      REQUIRE(o.exit_code == 0);
      const json& reported = o.run["outputs"]["to_terminal"];
      MESSAGE(where << threads << ": " << reported.dump());
      CHECK(reported["state"] == "ground");
      CHECK(reported["cause"] == "none");
      CHECK(std::abs(reported["y"].get<double>() - 3) < 0.15);
      CHECK(std::abs(reported["x"].get<double>()) < 0.15);
      CHECK(std::abs(reported["altitude"].get<double>()) < 0.05);
      check_link(o, where, 2000);
    }
  }
}
