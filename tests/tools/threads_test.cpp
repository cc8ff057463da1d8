// Graphs on ordinary threads, as the command runs them.
#include <doctest/doctest.h>
#include <sys/socket.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using command::TemporaryFolder;

constexpr const char* on_threads = " --clock real --concurrency threads --for ";
}  // namespace

TEST_SUITE("tools/threads") {
  TEST_CASE("a run on threads tells the time covered, and what was commanded and reached, as one of exotasks does") {
    const auto run = command::jarol(std::string("run specs/exolauv.yaml") + on_threads + "1.2s", "2>/dev/null");
    CHECK(run.exit_code == 0);
    CHECK(
        run.output.starts_with("exolauv: 1.2 s in real time on threads\n"
                               "               commanded     reached\n  depth            0.000"));
  }

  TEST_CASE("a vehicle that is lost ends the run, and is told") {
    const std::string port = jarol::tests::free_port(SOCK_STREAM);
    jarol::tests::Process vehicle("vehicle submarine --link lockstep --listen " + port);
    REQUIRE(vehicle.says("in lockstep at"));
    jarol::tests::Process run(std::string("run specs/exolauv.yaml") + on_threads +
                              "1h --set 'distributers.dune.link={type: lockstep, peer: " + port + "}'");
    CHECK_FALSE(run.says("error", std::chrono::seconds(1)));
    vehicle.kill();
    CHECK(run.end() == 3);
    const std::string& errors = run.errors();
    const std::size_t at = errors.find("error: at ");
    REQUIRE(at != std::string::npos);
    CHECK(errors.substr(errors.find(" s: ", at)) == " s: the other end has ended the connection\n");
    CHECK(std::stod(errors.substr(at + 10)) > 0.0);
  }

  TEST_CASE("the first thousand faults are told, and how many more there were") {
    const TemporaryFolder folder;
    std::string text =
        "graph: g\ntiming: {period: 1ms}\ncommunicators: {i: {type: double, direction: in, init: 1e308}}\n";
    std::string tasks = "tasks:\n", connections = "connections:\n";
    for (int t = 0; t < 50; ++t) {
      const std::string name = "t" + std::to_string(t);
      tasks += "  " + name + ": {type: Sum, on_fault: hold}\n";
      connections += "  - i -> " + name + ".a\n  - i -> " + name + ".b\n";
    }
    const auto graph = folder.write("g.yaml", text + tasks + connections);
    for (const char* concurrency : {"exotasks --clock virtual", "threads --clock real"}) {
      const std::string arguments = "run " + graph + " --for 200ms --concurrency " + concurrency;
      const auto json = nlohmann::json::parse(command::jarol(arguments + " --json", "2>/dev/null").output);
      CHECK(json["faults"].size() == 1000);
      CHECK(json["fault_count"] == json["activations"]);
      const std::string told = command::jarol(arguments, "2>&1 >/dev/null").output;
      const std::size_t more = told.find("fault: and ");
      REQUIRE(more != std::string::npos);
      CHECK(std::count(told.begin(), told.end(), '\n') == 1001);
      CHECK(std::stoi(told.substr(more + 11)) % 50 == 0);
      CHECK(told.ends_with(" more\n"));
    }
  }
}
