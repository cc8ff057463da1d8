// What streams do whose peers come, go, are silent or take nothing.
#include "distributers/links/stream.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <functional>
#include <thread>

#include "distributers/links/link.h"
#include "distributers/links/serial.h"
#include "distributers/links/tcp.h"
#include "distributers/messages/javiator.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
namespace javiator = messages::javiator;

bool wait_for(const std::function<bool()>& done) {
  const auto end = Clock::now() + 20s;  // a busy machine may take long
  while (!done()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

std::unique_ptr<Link> make(std::unique_ptr<Transport> transport) {
  auto link = std::make_unique<Link>(std::move(transport), javiator::message_set(), LinkOptions{});
  link->connect();
  return link;
}

std::uint64_t count_of(const Link& link, const std::string& name) {
  for (const auto& [counted, count] : link.report().counts)
    if (counted == name) return count;
  FAIL("no count of " << name);
  return 0;
}

void say(Link& link) {
  link.send(messages::refer_to(javiator::MotorSignals{}));
  link.flush();
}

Address at(int port) { return Address::parse("127.0.0.1:" + std::to_string(port)); }

struct Server {
  Server() {
    auto transport = std::make_unique<TcpServer>(at(0));
    const TcpServer& server = *transport;
    link = make(std::move(transport));
    address = at(server.port());
  }
  std::unique_ptr<Link> dial() const { return make(std::make_unique<TcpClient>(address)); }
  std::uint64_t peers() const { return link->transport().counts.connected; }
  std::unique_ptr<Link> link;
  Address address;
};

// A line at whose other end nobody reads, and a link that has opened it.
struct StuckLine {
  StuckLine() : other_end(posix_openpt(O_RDWR | O_NOCTTY)) {
    REQUIRE(grantpt(other_end.get()) == 0);
    REQUIRE(unlockpt(other_end.get()) == 0);
    const std::string name = ptsname(other_end.get());
    link = make(std::make_unique<SerialTransport>(name, 115200));
    REQUIRE(wait_for([&] { return link->transport().counts.connected == 1; }));
    const Descriptor line(::open(name.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK));
    const char bytes[4096] = {};
    // what is taken a little later fills it up
    for (int full = 0; full < 3; std::this_thread::sleep_for(2ms))
      full = ::write(line.get(), bytes, sizeof bytes) > 0 ? 0 : full + 1;
  }
  Descriptor other_end;
  std::unique_ptr<Link> link;
};
}  // namespace

TEST_SUITE("distributers/links/stream") {
  TEST_CASE("a server that ends each stream at once is tried at growing intervals") {
    const Descriptor socket = listen_at(at(0));
    const auto client = make(std::make_unique<TcpClient>(at(port_of(socket))));
    int streams = 0;
    for (const auto end = Clock::now() + 1s; Clock::now() < end;) {
      pollfd polled{socket.get(), POLLIN, 0};
      if (poll(&polled, 1, 10) == 1 && accept_from(socket)) ++streams;
    }
    // after 20, 40, 80, 160, 320 ms
    CHECK(streams >= 2);
    CHECK(streams <= 6);
  }

  TEST_CASE("a stream that was good is followed by another after the first pause") {
    const Descriptor socket = listen_at(at(0));
    const auto client = make(std::make_unique<TcpClient>(at(port_of(socket))));
    const unsigned char packet[] = {0xff, 0xff, 0x11, 0, 0, 0x11};
    const auto start = Clock::now();
    for (std::uint64_t streams = 1; streams <= 10; ++streams) {
      Descriptor stream;
      REQUIRE(wait_for([&] { return bool(stream = accept_from(socket)); }));
      REQUIRE(::write(stream.get(), packet, sizeof packet) == sizeof packet);
      REQUIRE(wait_for([&] { return count_of(*client, "packets in") == streams; }));
    }
    CHECK(Clock::now() - start < 2s);  // growing to 1 s the pauses would take 5 s
  }

  TEST_CASE("two clients at one server don't push each other out, whether they speak or not") {
    for (const bool speak : {true, false}) {
      CAPTURE(speak);
      const Server server;
      const auto one = server.dial(), other = server.dial();
      for (const auto end = Clock::now() + 1500ms; Clock::now() < end; std::this_thread::sleep_for(5ms))
        for (Link* link : {one.get(), other.get()})
          if (speak) say(*link);
      CHECK(server.peers() == 1);
    }
  }

  TEST_CASE("a newer peer takes the place of one that is silent, once it speaks; and of one that has ended") {
    const Server server;
    const Descriptor silent(socket(AF_INET, SOCK_STREAM, 0));
    REQUIRE(connect(silent.get(), server.address.get(), server.address.size()) == 0);
    REQUIRE(wait_for([&] { return server.peers() == 1; }));
    auto newer = server.dial();
    CHECK(wait_for([&] {
      say(*newer);
      return server.peers() == 2;
    }));
    CHECK(wait_for([&] { return count_of(*server.link, "packets in") > 0; }));
    newer.reset();
    const auto last = server.dial();
    CHECK(wait_for([&] { return server.peers() == 3; }));
  }

  TEST_CASE("a stream goes on while no other can be accepted") {
    const Server server;
    const auto client = server.dial();
    REQUIRE(wait_for([&] { return count_of(*client, "peers") == 1; }));
    say(*client);
    REQUIRE(wait_for([&] { return count_of(*server.link, "packets in") == 1; }));
    const Descriptor raw(socket(AF_INET, SOCK_STREAM, 0));
    rlimit before{};
    getrlimit(RLIMIT_NOFILE, &before);
    const Descriptor lowest(dup(raw.get()));
    const rlimit none{static_cast<rlim_t>(lowest.get() + 1), before.rlim_max};
    REQUIRE(setrlimit(RLIMIT_NOFILE, &none) == 0);
    CHECK(connect(raw.get(), server.address.get(), server.address.size()) == 0);
    std::this_thread::sleep_for(200ms);  // the server looks for others ten times a second
    std::uint64_t sent = 1;
    const bool all = wait_for([&] {
      if (sent < 20) say(*client), ++sent;
      return count_of(*server.link, "packets in") == 20;
    });
    setrlimit(RLIMIT_NOFILE, &before);
    CHECK(all);
    CHECK(server.peers() == 1);
  }

  TEST_CASE("a line that takes nothing holds up the end for one send, not for each that is pending") {
    const StuckLine stuck;
    for (int packet = 0; packet < 64; ++packet) stuck.link->send(messages::refer_to(javiator::MotorSignals{}));
    stuck.link->flush();
    const auto start = Clock::now();
    stuck.link->disconnect();
    CHECK(Clock::now() - start < 3s);  // 64 waits would take 12.8 s
    CHECK(count_of(*stuck.link, "unsent: no peer") == 64);
  }

  TEST_CASE("a line that takes again what is sent gets it") {
    const StuckLine stuck;
    REQUIRE(wait_for([&] {
      say(*stuck.link);
      return count_of(*stuck.link, "unsent: no peer") >= 2;
    }));
    fcntl(stuck.other_end.get(), F_SETFL, O_NONBLOCK);
    CHECK(wait_for([&] {
      char room[4096];
      while (::read(stuck.other_end.get(), room, sizeof room) > 0) {}
      say(*stuck.link);
      return count_of(*stuck.link, "packets out") > 0;
    }));
  }

  TEST_CASE("send signals to a sender that is busy are counted") {
    const StuckLine stuck;
    std::uint64_t signals = 0;
    CHECK(wait_for([&] {
      say(*stuck.link);
      ++signals;
      return count_of(*stuck.link, "send signals while busy") > 0;
    }));
    CHECK(count_of(*stuck.link, "send signals while busy") <= signals);
    CHECK(count_of(*Server().link, "send signals while busy") == 0);
  }
}
