// `jarol vehicle` over a link: what it writes, and how it announces itself.
#include <doctest/doctest.h>
#include <sys/socket.h>

#include <string>
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
}
