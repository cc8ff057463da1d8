// Runs that wait for another program when Ctrl-C comes: they answer within a second.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "distributers/links/tcp.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol::tests;
using namespace std::chrono_literals;
using command::TemporaryFolder;
using jarol::distributers::Address;
using jarol::distributers::listen_at;
using jarol::distributers::port_of;
using Clock = std::chrono::steady_clock;

struct Ended {
  int exit_code = 0;
  std::string errors;
};

// Of the arguments, ended by a signal when it surely waits; again where a busy machine makes it late.
Ended end_by(int signal, const std::string& arguments, const std::function<bool(Process&)>& waits) {
  Ended ended;
  Clock::duration took{};
  for (int attempt = 0; attempt < 5 && (attempt == 0 || took > 1s); ++attempt) {
    Process process(arguments);
    REQUIRE(waits(process));
    const auto begin = Clock::now();
    process.signal(signal);
    ended.exit_code = process.end();
    took = Clock::now() - begin;
    ended.errors = process.errors();
  }
  CHECK(took <= 1s);
  return ended;
}

bool waits_a_while(Process& process) {
  std::this_thread::sleep_for(500ms);
  return process.runs();
}

std::string make_fifo(const TemporaryFolder& folder) {
  const std::string fifo = folder / "fifo";
  REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
  return fifo;
}
}  // namespace

TEST_SUITE("tools/waiting") {
  TEST_CASE("a vehicle in lockstep that takes the connection and is mute is not waited for after the first signal") {
    const auto door = listen_at(Address::parse("0"), 16);
    const std::string port = std::to_string(port_of(door));
    const std::string link = " --set 'distributers.dune.link={type: lockstep, peer: " + port + "}'";
    for (const std::string way : {"", " --clock real --force", " --clock real --concurrency threads"}) {
      CAPTURE(way);
      const Ended ended = end_by(SIGINT, "run specs/exolauv.yaml" + way + link, waits_a_while);
      CAPTURE(ended.errors);
      CHECK(ended.exit_code == 130);
      CHECK(ended.errors.find("error: interrupted before the run began: the vehicle at 127.0.0.1:" + port +
                              " was silent when the run was to end\n") != std::string::npos);
    }
  }

  TEST_CASE("nor is one that falls silent on the way, which is lost then") {
    const std::string port = free_port(SOCK_STREAM);
    Process vehicle("vehicle submarine --parameters specs/vehicles/submarine.yaml --link lockstep --listen " + port);
    REQUIRE(vehicle.says("in lockstep at"));
    const std::string run =
        "run specs/exolauv.yaml --for 100h --set expect=nothing --set "
        "'distributers.dune.link={type: lockstep, peer: " +
        port + "}'";
    const Ended ended = end_by(SIGTERM, run, [&](Process& process) {
      vehicle.signal(SIGCONT);
      std::this_thread::sleep_for(500ms);
      vehicle.signal(SIGSTOP);
      return waits_a_while(process);
    });
    vehicle.signal(SIGCONT);
    CHECK(ended.exit_code == 3);
    CHECK(ended.errors.find("s: the vehicle at 127.0.0.1:" + port + " was silent when the run was to end\n") !=
          std::string::npos);
  }

  TEST_CASE("nor is who might read a FIFO") {
    const TemporaryFolder folder;
    const std::string fifo = make_fifo(folder), late = "error: can't write '" + fifo + "': Connection timed out\n";
    for (const std::string option : {"--record ", "--log "}) {
      CAPTURE(option);
      const Ended ended = end_by(SIGINT, "run specs/counting.yaml --for 1s " + option + fifo, waits_a_while);
      CHECK(ended.exit_code == 130);
      CHECK(ended.errors == "error: interrupted before the run began: " + late.substr(7));
    }
    const Ended picture = end_by(SIGTERM, "run specs/counting.yaml --for 1s --plot " + fifo, waits_a_while);
    CHECK(picture.exit_code == 3);
    CHECK(picture.errors.ends_with(late));
    // nothing has begun: it ends as any program does
    CHECK(end_by(SIGINT, "run specs/counting.yaml --for 1s --trace " + fifo, waits_a_while).exit_code == -SIGINT);
  }

  TEST_CASE("nor is who reads a FIFO and has stopped doing so") {
    const TemporaryFolder folder;
    const std::string fifo = make_fifo(folder);
    const int reader = ::open(fifo.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(reader >= 0);
    const Ended ended = end_by(SIGINT, "run specs/counting.yaml --for 1h --trace " + fifo, waits_a_while);
    ::close(reader);
    CHECK(ended.exit_code == 3);
    CHECK(ended.errors.ends_with("error: can't write '" + fifo + "': Connection timed out\n"));
  }
}
