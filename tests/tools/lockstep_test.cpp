#include "distributers/links/lockstep_server.h"

#include <doctest/doctest.h>
#include <sys/socket.h>

#include <cstdlib>
#include <thread>

#include "distributers/interfaces/vehicle_file.h"
#include "distributers/links/tcp.h"
#include "runtime/execute/executor.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"
#include "tools/commands/run/load_graph.h"
#include "tools/library/built_in.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;

// A vehicle's process, as a thread; each runner gets a vehicle from the start.
class Process {
 public:
  explicit Process(const std::string& file) {
    Problems problems;
    file_ = read_vehicle_file(read_source(file), built_in().vehicles, problems);
    problems.throw_if_any();
    thread_ = std::thread([this] {
      LockstepService service{
          .set = *file_->vehicle->message_set, .name = file_->vehicle->name, .make = [this](std::uint64_t seed) {
            return file_->vehicle->make(file_->parameters.data(), seed);
          }};
      service.note = [this](const std::string& text) { noted.push_back(text); };
      serve_lockstep(socket_, service, interrupter_);
    });
  }
  ~Process() { end(); }

  void end() {
    interrupter_.interrupt();
    if (thread_.joinable()) thread_.join();
  }

  std::string link() const { return "={type: lockstep, peer: '127.0.0.1:" + std::to_string(port_of(socket_)) + "'}"; }

  std::vector<std::string> noted;

 private:
  std::optional<VehicleFile> file_;
  Descriptor socket_ = listen_at(Address::parse("0"));
  Interrupter interrupter_;
  std::thread thread_;
};

std::uint64_t digest_of(const std::string& graph, const std::vector<std::string>& set, std::uint64_t seed,
                        Duration end) {
  Loaded loaded = tools::load_graph(graph, {.profile = "", .set = set}, seed);
  for (const auto& system : loaded.systems) system->begin();
  Executor executor(*loaded.graph, std::move(loaded.systems));
  executor.run_until(end);
  return executor.report().digest;
}
}  // namespace

TEST_SUITE("tools/lockstep") {
  TEST_CASE("a vehicle in another process gives the digest of the same vehicle in this one, run after run") {
    Process submarine("specs/vehicles/submarine.yaml");
    Process helicopter("specs/vehicles/helicopter.yaml");
    for (const std::uint64_t seed : {0, 7}) {
      CAPTURE(seed);
      CHECK(digest_of("specs/exolauv.yaml", {"distributers.dune.link" + submarine.link()}, seed, 3s) ==
            digest_of("specs/exolauv.yaml", {}, seed, 3s));
      CHECK(digest_of("specs/javiator.yaml", {"distributers.robostix.link" + helicopter.link()}, seed, 2s) ==
            digest_of("specs/javiator.yaml", {}, seed, 2s));
    }
    submarine.end();
    CHECK(submarine.noted.empty());
  }

  TEST_CASE("a vehicle that is lost ends the run, and is reported") {
    auto process = std::make_unique<Process>("specs/vehicles/submarine.yaml");
    Loaded loaded = tools::load_graph("specs/exolauv.yaml",
                                      {.profile = "", .set = {"distributers.dune.link" + process->link()}}, 0);
    for (const auto& system : loaded.systems) system->begin();
    Executor executor(*loaded.graph, std::move(loaded.systems));
    executor.run_until(3s);
    const std::string link = process->link();
    const std::string address = link.substr(link.find("127"), link.rfind('\'') - link.find("127"));
    process.reset();
    CHECK_THROWS_WITH_AS(executor.run_until(6s), ("the vehicle at " + address + " has ended the connection").c_str(),
                         FrameError);
    CHECK(executor.now() == 3s);
  }

  TEST_CASE("a vehicle that does not fit is refused, and so is no vehicle at all") {
    Process helicopter("specs/vehicles/helicopter.yaml");
    const auto begin = [](const std::string& link) {
      Loaded loaded =
          tools::load_graph("specs/exolauv.yaml", {.profile = "", .set = {"distributers.dune.link" + link}}, 0);
      for (const auto& system : loaded.systems) system->begin();
    };
    const std::string link = helicopter.link();
    const std::string address = link.substr(link.find("127"), link.rfind('\'') - link.find("127"));
    CHECK_THROWS_WITH(begin(link),
                      ("the vehicle at " + address + " does not fit: it speaks 'javiator', not 'imc'").c_str());
    helicopter.end();
    const std::string port = std::to_string(port_of(listen_at(Address::parse("0"))));  // free again at once
    CHECK_THROWS_WITH(begin("={type: lockstep, peer: " + port + "}"),
                      ("there is no vehicle at 127.0.0.1:" + port +
                       ": Connection refused; start one by 'jarol vehicle NAME --link lockstep --listen " + port + "'")
                          .c_str());
  }

  TEST_CASE("tasks are measured with a vehicle in another process, too, and not without it") {
    Process submarine("specs/vehicles/submarine.yaml");
    const auto measure = [](const std::string& link) {
      return command::run_jarol("check --measure specs/exolauv.yaml --for 1s --set \"distributers.dune.link" + link +
                                "\"");
    };
    const auto measured = measure(submarine.link());
    CHECK(measured.exit_code <= 1);  // a busy machine may need longer than a 'wcet' says
    CHECK(measured.output.starts_with(
        "specs/exolauv.yaml: measured over 1s of logical time on this machine, in processor time\n"));
    const std::string port = std::to_string(port_of(listen_at(Address::parse("0"))));  // free again at once
    const auto refused = measure("={type: lockstep, peer: " + port + "}");
    CHECK(refused.exit_code == 3);
    CHECK(refused.output.starts_with("error: there is no vehicle at 127.0.0.1:" + port + ": Connection refused; "));
  }

  TEST_CASE("what becomes of a vehicle in another process fails the run as it does in this one, and both report it") {
    const std::string port = tests::free_port(SOCK_STREAM);
    tests::Process vehicle("vehicle helicopter --parameters specs/vehicles/helicopter.yaml --link lockstep --listen " +
                           port);
    REQUIRE(vehicle.says("in lockstep at"));
    const auto fly = [](const std::string& options) {
      return command::run_jarol("run specs/javiator.yaml --set expect=nothing " + options, "2>&1 >/dev/null");
    };
    const std::string turned = "--set tasks.attitude.parameters.lean.effect=-66 ",
                      there = "--set 'distributers.robostix.link={type: lockstep, peer: " + port + "}'";
    const auto here = fly(turned), other = fly(turned + there);
    const std::string crash = "has crashed: a rotor met the ground, at ";
    CHECK(here.output.starts_with("error: the vehicle of 'robostix' " + crash));
    CHECK(here.exit_code == 1);
    CHECK(other.output == here.output);
    CHECK(other.exit_code == 1);
    // each has a vehicle of its own
    const auto good = fly(there);
    CHECK(good.output == "");
    CHECK(good.exit_code == 0);
    CHECK(fly(turned + there + " --for 2s").exit_code == 0);  // it crashes later
    const auto real = fly(turned + there + " --clock real --force --for 4s");
    CHECK(real.output.find("error: the vehicle of 'robostix' has crashed: ") != std::string::npos);
    CHECK(real.exit_code == 1);
    vehicle.interrupt();
    CHECK(vehicle.end() == 130);  // a signal's code is before that of a mishap
    const std::string lines = vehicle.errors();
    std::size_t reports = 0;
    for (std::size_t at = 0; (at = lines.find(" has crashed: ", at)) != std::string::npos; ++at) ++reports;
    CHECK(reports == 2);
    CHECK(lines.find("\nerror: the helicopter of the runner at 127.0.0.1:") != std::string::npos);
  }

  TEST_CASE("a vehicle whose reports nobody reads any more serves on") {
    const command::TemporaryFolder folder;
    const std::string port = tests::free_port(SOCK_STREAM), id = folder / "id";
    REQUIRE(std::system(("(" JAROL_COMMAND " vehicle helicopter --parameters specs/vehicles/helicopter.yaml --set "
                         "frame.mass=6 --link lockstep --listen " +
                         port + " 2>&1 & echo $! > " + id + "; wait) | true &")
                            .c_str()) == 0);
    // each leaves something to report: it is too heavy to take off
    for (int runs = 0, tries = 0; runs < 3 && tries < 200; ++tries) {
      const auto run = command::run_jarol(
          "run specs/javiator.yaml --set expect=nothing --set 'distributers.robostix.link={type: lockstep, peer: " +
          port + "}'");
      if (run.exit_code == 3) std::this_thread::sleep_for(100ms);  // not yet there
      if (run.exit_code == 3 && runs == 0) continue;
      ++runs;
      CHECK(run.exit_code == 1);
      CHECK(run.output.find("error: the vehicle of 'robostix' has never taken off: ") != std::string::npos);
    }
    CHECK(std::system(("kill -TERM $(cat " + id + ")").c_str()) == 0);
  }

  TEST_CASE("periods that do not fall on the vehicle's steps are refused") {
    Process helicopter("specs/vehicles/helicopter.yaml");
    Loaded loaded = tools::load_graph(
        "specs/javiator.yaml",
        {.profile = "",
         .set = {"distributers.robostix.link" + helicopter.link(), "communicators.from_robostix.offset=1ms"}},
        0);
    std::string error;
    try {
      for (const auto& system : loaded.systems) system->begin();
    } catch (const FrameError& refused) { error = refused.what(); }
    CHECK(error.substr(error.find("fit: ")) ==
          "fit: communicator 'from_robostix' has offset 1ms; it has to be a multiple of the vehicle's step of 5ms");
  }
}
