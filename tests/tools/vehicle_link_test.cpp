// `jarol vehicle` over a link: what it writes, and how it announces itself.
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "distributers/links/address.h"
#include "distributers/links/descriptor.h"
#include "tests/tools/csv_rows.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using command::TemporaryFolder;
namespace links = jarol::distributers;
}  // namespace

TEST_SUITE("tools/vehicle_link") {
  TEST_CASE("over a link its motion is written, too, up to where it is ended") {
    const TemporaryFolder folder;
    const auto run = command::run_jarol(
        "vehicle submarine --initial z=4 --link udp --listen 0 --for 200ms --rate 20 --csv " + folder / "out.csv",
        "2>/dev/null");
    CHECK(run.exit_code == 0);
    const auto rows = command::rows_of(folder / "out.csv");
    REQUIRE(rows.size() == 5);
    for (std::size_t i = 0; i < rows.size(); ++i) CHECK(rows[i][0] == doctest::Approx(0.05 * static_cast<double>(i)));
    CHECK(rows.front()[3] == 4);
    CHECK(rows.back()[3] < 4);  // it rises
  }

  TEST_CASE("with --announce it announces itself at once, with the port at which it listens, and not again in 300 ms") {
    const links::Descriptor socket(::socket(AF_INET, SOCK_DGRAM, 0));
    const links::Address any = links::Address::parse("0");
    REQUIRE(::bind(socket.get(), any.get(), any.size()) == 0);
    const std::string port = jarol::tests::free_port(SOCK_DGRAM);
    CHECK(command::run_jarol("vehicle submarine --link udp --listen " + port + " --for 300ms --announce " +
                                 std::to_string(links::port_of(socket)),
                             "2>/dev/null")
              .exit_code == 0);
    std::vector<std::string> heard;
    char room[1024];
    for (long size; (size = ::recv(socket.get(), room, sizeof room, MSG_DONTWAIT)) > 0;)
      heard.emplace_back(room, static_cast<std::size_t>(size));
    REQUIRE(heard.size() == 1);
    CHECK(heard[0].find("lauv-simulator-1") != std::string::npos);
    CHECK(heard[0].find("imc+udp://127.0.0.1:" + port + "/") != std::string::npos);
  }

  TEST_CASE(
      "a vehicle that announces itself to where nobody can answer notes that, and reports what it could not send") {
    const std::string port = jarol::tests::free_port(SOCK_DGRAM);
    const auto run = command::run_jarol("vehicle submarine --link udp --listen " + port +
                                        " --for 100ms --announce 127.0.0.1:0,192.0.2.1:30100");
    CHECK(run.output.find(
              "note: the submarine announces itself to 192.0.2.1:30100, which can't answer, as 127.0.0.1:" + port +
              " is reached from this machine alone; listen at 0.0.0.0:" + port + "\n") != std::string::npos);
    CHECK(run.output.find(", 1 unsent: announcements to 127.0.0.1:0 (Invalid argument)") != std::string::npos);
  }

  TEST_CASE("a peer that sends back what it gets is no vehicle: the run says that nothing came, and ends with 3") {
    std::atomic<bool> ends{false};
    const int echo = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    REQUIRE(::bind(echo, reinterpret_cast<sockaddr*>(&place), size) == 0);
    REQUIRE(::getsockname(echo, reinterpret_cast<sockaddr*>(&place), &size) == 0);
    std::thread echoing([&] {
      while (!ends) {
        char packet[2048];
        sockaddr_in from{};
        socklen_t length = sizeof from;
        const auto bytes = ::recvfrom(echo, packet, sizeof packet, 0, reinterpret_cast<sockaddr*>(&from), &length);
        if (bytes < 0)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        else
          ::sendto(echo, packet, static_cast<std::size_t>(bytes), 0, reinterpret_cast<sockaddr*>(&from), length);
      }
    });
    const auto [exit_code, text] =
        command::run_jarol("run specs/exolauv_bare.yaml --set 'distributers.dune.link={type: udp, peer: \"127.0.0.1:" +
                           std::to_string(ntohs(place.sin_port)) + "\"}' --for 500ms --clock real");
    ends = true;
    echoing.join();
    ::close(echo);
    CHECK(exit_code == 3);
    CHECK(text.find("error: nothing came from the vehicle of 'dune' in the whole run; is it there?\n") !=
          std::string::npos);
    CHECK(text.find("NO PACKET THAT COUNTS HAS COME over udp") != std::string::npos);
  }
}
