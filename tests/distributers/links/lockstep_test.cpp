#include "distributers/links/lockstep.h"

#include <doctest/doctest.h>
#include <poll.h>

#include <cstring>
#include <thread>

#include "distributers/interfaces/typed.h"
#include "distributers/lauv/vehicle.h"
#include "distributers/links/tcp.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;

// One that has come, and was greeted as by a vehicle's process of that grid.
FrameStream greeted(const Descriptor& socket, std::int64_t grid) {
  Descriptor runner;
  while (!runner) runner = accept_from(socket);
  FrameStream stream(std::move(runner));
  std::vector<std::byte> welcome(19);
  const std::uint64_t version = 2;
  std::memcpy(welcome.data(), &version, 8);
  std::memcpy(welcome.data() + 8, &grid, 8);
  std::memcpy(welcome.data() + 16, "imc", 3);
  stream.put(FrameKind::welcome, welcome);
  stream.flush();
  return stream;
}

// What a runner says to a vehicle's process whose welcome states that grid.
std::string said_to(std::int64_t grid) {
  const Descriptor socket = listen_at(Address::parse("0"));
  const Address address = Address::parse(std::to_string(port_of(socket)));
  std::thread process([&] {
    FrameStream stream = greeted(socket, grid);
    CHECK_THROWS_AS(stream.read(), FrameError);  // until it has gone
  });
  std::string said;
  try {
    LockstepSystem system(address, 0, std::make_unique<Typed<LauvVehicle>>(), [](Duration its) {
      return Duration(1000).count() % its.count() == 0 ? std::string() : std::string("off its grid");
    });
    system.begin();
  } catch (const FrameError& error) { said = error.what(); }
  process.join();
  const std::string who = "the vehicle at " + address.text() + " does not fit: ";
  return said.substr(0, who.size()) == who ? said.substr(who.size()) : said;
}
}  // namespace

TEST_SUITE("distributers/links/lockstep") {
  TEST_CASE("a vehicle is refused whose step is not above zero") {
    CHECK(said_to(0) == "its step is 0ns; it has to be above zero");
    CHECK(said_to(-7) == "its step is -7ns; it has to be above zero");
    CHECK(said_to(7) == "off its grid");
    CHECK(said_to(10) == "");
  }

  TEST_CASE("an answer that comes twice ends the run, as what it has is of another step") {
    const Descriptor socket = listen_at(Address::parse("0"));
    const Address address = Address::parse(std::to_string(port_of(socket)));
    std::thread process([&] {
      FrameStream stream = greeted(socket, 5'000'000);
      try {
        for (std::uint64_t steps = 0;;) {
          const FrameStream::Frame asked = stream.read();
          if (asked.kind == FrameKind::step) ++steps;
          if (asked.kind != FrameKind::sense) continue;
          for (int i = 0; i < (steps < 3 ? 1 : 2); ++i)
            stream.put(FrameKind::sensed, std::as_bytes(std::span(&steps, 1)));
          stream.flush();
        }
      } catch (const FrameError&) {
        // until it has gone
      }
    });
    {
      LockstepSystem system(address, 0, std::make_unique<Typed<LauvVehicle>>(), [](Duration) { return std::string(); });
      system.begin();
      system.reach(std::chrono::milliseconds(15));
      CHECK_THROWS_WITH_AS(system.reach(std::chrono::milliseconds(20)),
                           ("the vehicle at " + address.text() +
                            " is out of step: got what it senses after step 3, expected that after step 4")
                               .c_str(),
                           FrameError);
    }
    process.join();
  }

  TEST_CASE("a connection has ended also when the other end goes with bytes unread, which resets it") {
    const Descriptor socket = listen_at(Address::parse("0"));
    const std::string port = std::to_string(port_of(socket));
    FrameStream stream = FrameStream::connect(Address::parse(port));
    Descriptor other;
    while (!other) other = accept_from(socket);
    stream.put(FrameKind::step);
    stream.flush();
    pollfd unread{other.get(), POLLIN, 0};
    REQUIRE(poll(&unread, 1, 20'000) == 1);
    other = Descriptor();
    CHECK_THROWS_WITH_AS(stream.read(), ("the vehicle at 127.0.0.1:" + port + " has ended the connection").c_str(),
                         FrameEnd);
  }

  TEST_CASE("connecting to where nobody answers has an end") {
    using namespace std::chrono_literals;
    const Descriptor socket = listen_at(Address::parse("0"));
    const std::string port = std::to_string(port_of(socket));
    const Address address = Address::parse(port);
    // those that nobody accepts fill the queue; the system then answers no more
    std::vector<Descriptor> queue;
    for (int i = 0; i < 5; ++i) {
      queue.emplace_back(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0));
      connect(queue.back().get(), address.get(), address.size());
      pollfd connected{queue.back().get(), POLLOUT, 0};
      if (i < 2) REQUIRE(poll(&connected, 1, 20'000) == 1);
    }
    const auto start = std::chrono::steady_clock::now();
    CHECK_THROWS_WITH_AS(
        FrameStream::connect(address, 100ms),
        ("there is no vehicle at 127.0.0.1:" + port +
         ": Connection timed out; start one by 'jarol vehicle NAME --link lockstep --listen " + port + "'")
            .c_str(),
        FrameError);
    CHECK(std::chrono::steady_clock::now() - start < 60s);  // the system by itself tries for two minutes
  }
}
