// Vehicles, distributers and link types from shared libraries.
#include <doctest/doctest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <filesystem>

#include "distributers/links/descriptor.h"
#include "distributers/registries.h"
#include "graph/plugins/plugins.h"
#include "tests/tools/plugin_library.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"
#include "tools/library/built_in.h"

namespace {
using namespace jarol;
using jarol::tests::library;

// The other end of a link of local sockets, which answers with what it gets.
class LocalEnd {
 public:
  explicit LocalEnd(const std::string& path) {
    const sockaddr_un address = address_of(path);
    REQUIRE(::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  }

  /// One datagram; false: none comes any more from a process that has ended.
  bool echo_to(const std::string& path, tests::Process& from) {
    std::array<char, 1000> packet{};
    ssize_t length = -1;
    for (bool runs = true; length < 0 && runs;) {
      runs = from.runs();
      pollfd ready{socket_.get(), POLLIN, 0};
      ::poll(&ready, 1, runs ? 10 : 0);
      length = ::recv(socket_.get(), packet.data(), packet.size(), MSG_DONTWAIT);
    }
    const sockaddr_un address = address_of(path);
    if (length > 0)
      ::sendto(socket_.get(), packet.data(), static_cast<std::size_t>(length), MSG_DONTWAIT | MSG_NOSIGNAL,
               reinterpret_cast<const sockaddr*>(&address), sizeof address);
    return length >= 0;
  }

 private:
  static sockaddr_un address_of(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    return address;
  }

  distributers::Descriptor socket_{::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)};
};
}  // namespace

TEST_SUITE("tools/plugins_world") {
  TEST_CASE("a plugin brings a vehicle and its distributer, and a graph with them runs and is judged") {
    const command::TemporaryFolder folder;
    folder.write("lamp.yaml", "vehicle: lamp\nparameters: {gain: 2}\n");
    const std::string plugin = std::filesystem::absolute(library("world"));
    const std::string graph = folder.write("g.yaml", "graph: g\ntiming: {period: 10ms}\nplugins: [" + plugin + R"(]
distributers: {lamp: {type: LampSwitch, link: {type: simulation, vehicle: lamp.yaml, parameters: {gain: 3}}}}
communicators: {level: {channel: lamp.level, offset: 0ms}}
tasks: {count: {type: Counter, let: 10ms}}
connections: [count.out -> level]
expect: [light of lamp within 0.1 of 291]
)");
    const auto ran = command::run_jarol("run " + graph + " --for 1s", "2>/dev/null");
    CHECK(ran.output.find("  expected    light of lamp within 0.1 of 291: holds, 291\n") != std::string::npos);
    CHECK(ran.exit_code == 0);
    // each run of a campaign makes the vehicle again
    const auto campaign =
        command::run_jarol("campaign " + graph + " --for 1s --set expect=nothing --results " + (folder / "r.sqlite") +
                               " --vary 'distributers.lamp.link.parameters.gain=[1, 2]' --metric "
                               "'light=light of lamp'",
                           "2>/dev/null");
    CAPTURE(campaign.output);
    CHECK(campaign.output.find("  min light: 97 in run 0\n") != std::string::npos);
    CHECK(campaign.output.find("  max light: 194 in run 1\n") != std::string::npos);
    CHECK(campaign.exit_code == 0);
    const auto described = command::run_jarol("vehicle lamp --describe --plugin " + plugin, "2>/dev/null");
    CHECK(described.output.starts_with("lamp: shines\n"));
    const auto read = command::run_jarol(
        "vehicle lamp --describe --parameters " + (folder / "lamp.yaml") + " --plugin " + plugin, "2>/dev/null");
    CHECK(read.output.ends_with("\n  gain  2  of its light\n"));
    CHECK(command::run_jarol("tasks LampSwitch --plugin " + plugin).output.starts_with("LampSwitch: a lamp\n"));
    CHECK(command::run_jarol("vehicle lamp --describe").output.find("there is no vehicle 'lamp'") != std::string::npos);
  }

  TEST_CASE("a vehicle of a plugin that can't be is refused before it moves") {
    const command::TemporaryFolder folder;
    folder.write("lamp.yaml", "vehicle: lamp\n");
    const auto graph_with = [&](const std::string& plugin, const std::string& gain) {
      return folder.write("g.yaml", "graph: g\ntiming: {period: 10ms}\nplugins: [" + plugin +
                                        "]\ndistributers:\n  lamp: {type: LampSwitch, link: {type: simulation, "
                                        "vehicle: lamp.yaml, parameters: {gain: " +
                                        gain + "}}}\n");
    };
    const std::string world = std::filesystem::absolute(library("world"));
    const std::string made = ":5:62: error: vehicle 'lamp' can't be made: ";
    const auto empty = command::run_jarol("check " + graph_with(world, "0"));
    CHECK(empty.output.find("g.yaml" + made + "its grid() is 0ns; a step has a length above zero, as in 10ms\n") !=
          std::string::npos);
    CHECK(empty.exit_code == 2);
    const auto bright = command::run_jarol("run " + graph_with(world, "2000") + " --for 1s");
    CHECK(bright.output.find("g.yaml" + made + "its constructor throws what is no std::exception\n") !=
          std::string::npos);
    CHECK(bright.exit_code == 2);
    const auto alone =
        command::run_jarol("vehicle lamp --plugin " + world + " --set gain=0 --script " +
                           folder.write("s.csv", "time,level\n0,1\n1,2\n") + " --csv " + (folder / "m.csv"));
    CHECK(alone.output ==
          "error: vehicle 'lamp' can't be made: its grid() is 0ns; a step has a length above zero, as in 10ms\n");
    CHECK(alone.exit_code == 2);
    const std::string two = std::filesystem::absolute(library("two_ranges"));
    const std::string wrong =
        "'" + two +
        "' throws when it is loaded: vehicle 'lamp' has another number of ranges (2) than of inputs (1); "
        "Inputs::ranges() gives one for each, in their order\n";
    const auto ranged = command::run_jarol("check " + graph_with(two, "1"));
    CHECK(ranged.output.find("g.yaml:3:11: error: " + wrong) != std::string::npos);
    CHECK(ranged.exit_code == 2);
    const auto described = command::run_jarol("vehicle lamp --describe --plugin " + two);
    CHECK(described.output.find("error: " + wrong) != std::string::npos);
    CHECK(described.exit_code == 2);
  }

  TEST_CASE("a plugin brings a link type, and a graph speaks over it with what is at the other end") {
    const command::TemporaryFolder folder;
    const auto path = [](const std::string& name) { return std::filesystem::absolute(library(name)).string(); };
    const std::string graph = folder.write(
        "g.yaml", "graph: g\ntiming: {period: 10ms}\nplugins: [" + path("world") + ", " + path("local") +
                      "]\ndistributers: {lamp: {type: LampSwitch, link: {type: local, listen: " + (folder / "graph") +
                      ", peer: " + (folder / "lamp") + R"(}}}
communicators:
  level: {channel: lamp.level, offset: 0ms, safe: 0}
  echo: {channel: lamp.echo, timeout: 1s}
tasks:
  count: {type: Counter, let: 10ms, wcet: 100us, on_fault: hold}  # late on a busy machine
  seen: {type: Relay, let: 10ms, wcet: 100us, on_fault: hold}
connections: [count.out -> level, echo -> seen.in]
)");
    LocalEnd lamp(folder / "lamp");
    tests::Process run("run " + graph + " --clock real --for 1s --force --json");
    std::uint64_t heard = 0;
    while (lamp.echo_to(folder / "graph", run)) ++heard;
    CHECK(run.end() == 0);
    const nlohmann::json link = run.json()["links"][0];
    CHECK(link["link"] == "local " + (folder / "graph") + " with " + (folder / "lamp"));
    CHECK(heard > 10);
    CHECK(link["counts"]["packets out"] == heard);
    CHECK(link["counts"]["packets in"] > 10);
    const std::string text = link["link"];
    CHECK(run.errors().find("note: the guardian has no way over " + text +
                            ", and a crash leaves the last commands in force there\n") != std::string::npos);
    CHECK(run.json()["guardian"] ==
          nlohmann::json{{"ready", false}, {"safe", nlohmann::json::array()}, {"unreached", {text}}});
    const auto wrong =
        command::run_jarol("run " + graph + " --clock real --for 1s --set distributers.lamp.link.peer=null");
    CHECK(wrong.output.find("lacks the key 'peer'") != std::string::npos);
    CHECK(wrong.exit_code == 2);
  }

  TEST_CASE(
      "a plugin with a vehicle, distributer or link type that there is already is refused, and nothing of it is "
      "added") {
    distributers::Registries there = built_in();
    vehicles::VehicleClass submarine;  // which is not there in a build without Simbody
    submarine.name = "submarine";
    if (there.vehicles.find("submarine") == nullptr) there.vehicles.add(submarine);
    for (const auto& [name, what] : {std::pair{"clash_of_vehicles", "a vehicle 'submarine'"},
                                     {"clash_of_distributers", "a distributer 'LauvOperator'"},
                                     {"clash_of_links", "a link type 'udp'"}}) {
      PluginParts known{built_in().graph, {}};
      const std::string wrong = load_plugin(
          library(name), known, [&](const Extension& extension) { return distributers::has(there, extension); });
      CHECK(wrong == "'" + library(name) + "' brings " + what + ", which there is already");
      CHECK(known.extensions.empty());
      CHECK(known.graph.distributers().size() == built_in().graph.distributers().size());
    }
    PluginParts known{built_in().graph, {}};
    const IsThere none = [](const Extension&) { return false; };
    CHECK(load_plugin(library("world"), known, none) == "");
    CHECK(load_plugin(library("world"), known, none) ==
          "'" + library("world") + "' brings a distributer 'LampSwitch', which there is already");
    CHECK(known.extensions.size() == 1);
  }
}
