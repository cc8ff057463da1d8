// What streams do whose peers come, go, are silent or take nothing.
#include "distributers/links/stream.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <functional>
#include <thread>

#include "distributers/links/link.h"
#include "distributers/links/serial.h"
#include "distributers/links/tcp.h"
#include "distributers/messages/javiator.h"
#include "graph/text/errors.h"
#include "tests/distributers/links/pairs.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
using tests::count_of, tests::patience, tests::wait_for;
using Clock = std::chrono::steady_clock;
namespace javiator = messages::javiator;

std::unique_ptr<Link> make(std::unique_ptr<Transport> transport, const LinkOptions& options = {}) {
  auto link = std::make_unique<Link>(std::move(transport), javiator::message_set(), options);
  link->connect();
  return link;
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
  explicit StuckLine(std::size_t packets = 64) : other_end(posix_openpt(O_RDWR | O_NOCTTY)) {
    REQUIRE(grantpt(other_end.get()) == 0);
    REQUIRE(unlockpt(other_end.get()) == 0);
    const std::string name = ptsname(other_end.get());
    link = make(std::make_unique<SerialTransport>(name, 115200),
                {.input = {}, .output = {PortKind::plain, packets}, .header = {}});
    REQUIRE(wait_for([&] { return link->transport().counts.connected == 1; }));
    const Descriptor line(::open(name.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK));
    const char bytes[4096] = {};
    // there are two buffers, and the system carries what it takes from one into the other when it gets to it
    constexpr int other_buffer = 4095;
    for (int full = 0; full < 5; std::this_thread::sleep_for(2ms)) {
      int carried = 0;
      REQUIRE(ioctl(other_end.get(), FIONREAD, &carried) == 0);
      full = ::write(line.get(), bytes, sizeof bytes) > 0 || carried < other_buffer ? 0 : full + 1;
    }
  }
  Descriptor other_end;
  std::unique_ptr<Link> link;
};
}  // namespace

TEST_SUITE("distributers/links/stream") {
  TEST_CASE("a server that ends each stream at once is tried at growing intervals") {
    const Descriptor socket = listen_at(at(0));
    const auto client = make(std::make_unique<TcpClient>(at(port_of(socket))));
    Clock::time_point before, look;
    const auto accept = [&] {
      look = Clock::now();
      return bool(accept_from(socket));  // and ends it
    };
    REQUIRE(wait_for(accept));
    for (auto pause = 20ms; pause <= 320ms; pause *= 2) {
      before = look;
      REQUIRE(wait_for(accept));
      CHECK(Clock::now() - before >= pause);
    }
  }

  TEST_CASE("a stream that was good is followed by another after the first pause") {
    const Descriptor socket = listen_at(at(0));
    const auto client = make(std::make_unique<TcpClient>(at(port_of(socket))));
    const unsigned char packet[] = {0xff, 0xff, 0x11, 0, 0, 0x11};
    const auto start = Clock::now();
    // on a busy machine most may take long; but growing each would from the sixth on
    auto shortest = Clock::duration::max();
    for (std::uint64_t streams = 1; streams <= 7 || (shortest > 300ms && Clock::now() - start < patience); ++streams) {
      Descriptor stream;
      const auto ended = Clock::now();
      REQUIRE(wait_for([&] { return bool(stream = accept_from(socket)); }));
      if (streams > 6) shortest = std::min(shortest, Clock::now() - ended);
      REQUIRE(::write(stream.get(), packet, sizeof packet) == sizeof packet);
      REQUIRE(wait_for([&] { return count_of(*client, "packets in") == streams; }));
    }
    CHECK(shortest <= 300ms);
  }

  TEST_CASE("two clients at one server don't push each other out, whether they speak or not") {
    const Server silent;
    const auto first = silent.dial(), second = silent.dial();
    // again where the machine was so busy that a second went by between two packets of those who speak
    for (int attempt = 0; attempt < 10; ++attempt) {
      auto heard = Clock::now();  // when the last packet had not come yet
      const Server server;
      // who has not spoken yet gives way to who has
      const auto one = server.dial();
      REQUIRE(wait_for([&] { return server.peers() == 1 && silent.peers() == 1; }));
      REQUIRE(wait_for([&] {
        say(*one);
        return count_of(*server.link, "packets in") > 0;
      }));
      const auto other = server.dial();
      Clock::duration longest{};
      auto before = Clock::now();
      const auto end = before + 1300ms;
      for (std::uint64_t packets = 0; before < end; std::this_thread::sleep_for(5ms)) {
        for (Link* link : {one.get(), other.get()}) say(*link);
        const std::uint64_t now_packets = count_of(*server.link, "packets in");
        const auto now = Clock::now();
        longest = std::max(longest, now - heard);
        if (now_packets != packets) heard = before;
        packets = now_packets;
        before = now;
      }
      CHECK(silent.peers() == 1);
      const std::uint64_t peers = server.peers();
      longest = std::max(longest, Clock::now() - heard);
      if (longest >= 900ms && peers != 1) continue;
      CHECK(peers == 1);
      return;
    }
    MESSAGE("this machine was too busy for two who speak without a pause");
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

  TEST_CASE("a line that is unplugged is opened again when it is there again") {
    const std::string name = "/tmp/jarol_line_" + std::to_string(getpid());  // as /dev/ttyUSB0, which comes and goes
    const auto plug_in = [&] {
      Descriptor other_end(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK));
      REQUIRE(grantpt(other_end.get()) == 0);
      REQUIRE(unlockpt(other_end.get()) == 0);
      unlink(name.c_str());
      REQUIRE(symlink(ptsname(other_end.get()), name.c_str()) == 0);
      return other_end;
    };
    Descriptor other_end = plug_in();
    const auto link = make(std::make_unique<SerialTransport>(name, 115200));
    const unsigned char packet[] = {0xff, 0xff, 0x11, 0, 0, 0x11};
    for (std::uint64_t times = 1; times <= 3; ++times) {
      REQUIRE(wait_for([&] { return count_of(*link, "peers") == times; }));
      REQUIRE(::write(other_end.get(), packet, sizeof packet) == sizeof packet);
      REQUIRE(wait_for([&] { return count_of(*link, "packets in") == times; }));
      say(*link);
      REQUIRE(wait_for([&] { return count_of(*link, "packets out") == times; }));
      unlink(name.c_str());
      other_end.close();
      REQUIRE(wait_for([&] { return count_of(*link, "ends of stream") == times; }));
      say(*link);
      CHECK(wait_for([&] { return count_of(*link, "unsent: no peer") == times; }));
      if (times < 3) other_end = plug_in();
    }
  }

  TEST_CASE("a line is one process's, until the last who holds it is gone") {
    const Descriptor other_end(posix_openpt(O_RDWR | O_NOCTTY));
    REQUIRE(grantpt(other_end.get()) == 0);
    REQUIRE(unlockpt(other_end.get()) == 0);
    const std::string name = ptsname(other_end.get());
    // as the guardian does
    struct Twin : Holder {
      void hold(int fd, const std::vector<Address>&) override { held = Descriptor(dup(fd)); }
      void let_go() override {}
      bool set_steers_itself(bool) override { return true; }
      Descriptor held;
    } twin;
    auto transport = std::make_unique<SerialTransport>(name, 115200);
    transport->holder = &twin;
    auto first = make(std::move(transport));
    REQUIRE(wait_for([&] { return count_of(*first, "peers") == 1; }));
    const std::string refusal = "can't open serial " + name + " at 9600 baud: it is in use by another process";
    CHECK_THROWS_WITH_AS(make(std::make_unique<SerialTransport>(name, 9600)), refusal.c_str(), InputError);
    termios settings{};
    const Descriptor look(::open(name.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK));
    REQUIRE(tcgetattr(look.get(), &settings) == 0);
    CHECK(cfgetospeed(&settings) == B115200);  // nor did the refused one change it
    first.reset();
    CHECK_THROWS_WITH_AS(make(std::make_unique<SerialTransport>(name, 9600)), refusal.c_str(), InputError);
    std::thread last([&] {
      std::this_thread::sleep_for(50ms);
      twin.held.close();
    });
    const auto next = make(std::make_unique<SerialTransport>(name, 9600));
    last.join();
    CHECK(wait_for([&] { return count_of(*next, "peers") == 1; }));
    next->disconnect();
    next->connect();  // a link may be begun again
    CHECK(wait_for([&] { return count_of(*next, "peers") == 2; }));
  }

  TEST_CASE("a line that takes nothing holds up the end for one send, not for each that is pending") {
    constexpr std::size_t packets = 300;
    const StuckLine stuck(packets);
    for (std::size_t i = 0; i < packets; ++i) stuck.link->send(messages::refer_to(javiator::MotorSignals{}));
    stuck.link->flush();
    const auto start = Clock::now();
    stuck.link->disconnect();
    CHECK(Clock::now() - start < 30s);  // as many waits would take a minute
    CHECK(count_of(*stuck.link, "unsent: no peer") == packets);
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
