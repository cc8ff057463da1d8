// Others than the peer, over UDP: whoever speaks first, comes between, or floods.
#include <doctest/doctest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <random>
#include <thread>

#include "distributers/interfaces/typed.h"
#include "distributers/javiator/operator.h"
#include "distributers/links/linked.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "distributers/messages/packet.h"
#include "tests/distributers/links/open_link.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
using namespace jarol::tests;
namespace imc = messages::imc;
namespace javiator = messages::javiator;
}  // namespace

TEST_SUITE("distributers/links/strangers") {
  TEST_CASE("of several that send valid and invalid datagrams one is heard: the first that spoke validly") {
    for (unsigned round = 0; round < 20; ++round) {
      CAPTURE(round);
      std::mt19937 random(round);
      const Open<UdpTransport> open;
      std::vector<Speaker> speakers;
      for (int i = 0; i < 4; ++i) speakers.emplace_back(open.address, SOCK_DGRAM);
      int owner = -1;
      std::vector<int> expected;
      std::uint64_t strangers = 0, times[4] = {};
      for (int step = 0; step < 200; ++step) {
        const int who = static_cast<int>(random() % 4);
        auto bytes = packet_of(step);
        const bool valid = random() % 3 == 0;
        if (!valid) bytes[random() % bytes.size()] ^= std::byte{0x10};
        speakers[static_cast<std::size_t>(who)].say(bytes);
        if (owner >= 0 && who != owner) {
          ++strangers;
          ++times[who];
        } else if (valid) {
          owner = who;
          expected.push_back(step);
        }
        // one after the other, as each waits until the one before was looked at
        REQUIRE(wait_for([&] {
          return looked_at(*open.link) + open.count("dropped: stranger") == static_cast<std::uint64_t>(step) + 1;
        }));
      }
      Ids got;
      open.link->receive(got);
      CHECK(got.ids == expected);
      CHECK(open.count("dropped: stranger") == strangers);
      CHECK(open.count("peers") == 1);
      const LinkReport report = open.link->report();
      std::uint64_t listed = 0;
      for (const LinkReport::Stranger& stranger : report.strangers)
        for (int i = 0; i < 4; ++i)
          if (stranger.address == speakers[static_cast<std::size_t>(i)].name) {
            CHECK(stranger.times == times[i]);
            ++listed;
          }
      CHECK(listed == report.strangers.size());
      CHECK(listed == 3);
      CHECK(report.takeovers.empty());
    }
  }

  TEST_CASE("a peer that has fallen silent is replaced, which is reported with both addresses") {
    const Open<UdpTransport> open(300ms);
    const Speaker first(open.address, SOCK_DGRAM), second(open.address, SOCK_DGRAM);
    first.say(1);
    REQUIRE(wait_for([&] { return open.count("packets in") == 1; }));
    // counted last, once it has all that it needs to be answered
    CHECK(wait_for([&] {
      second.say(2);
      return open.count("peers") == 2;
    }));
    const LinkReport report = open.link->report();
    REQUIRE(report.takeovers.size() == 1);
    CHECK(report.takeovers[0].from == first.name);
    CHECK(report.takeovers[0].to == second.name);
    CHECK(report.takeovers[0].at >= 300ms);
    CHECK(open.count("takeovers") == 1);
  }

  TEST_CASE("reports to a port that was closed stop; what was sent from it before still counts, and another may come") {
    const Open<UdpTransport> open;
    {
      const Speaker gone(open.address, SOCK_DGRAM);
      gone.say(1);
      REQUIRE(wait_for([&] { return open.count("peers") == 1; }));
    }
    open.link->send(messages::refer_to(javiator::MotorSignals{}));
    open.link->flush();
    REQUIRE(wait_for([&] { return open.count("closed ports") == 1 && open.count("packets out") == 1; }));
    const std::uint64_t sent = open.count("packets out"), unsent = open.count("unsent: no peer");
    for (int i = 0; i < 10; ++i) open.link->send(messages::refer_to(javiator::MotorSignals{}));
    open.link->flush();
    CHECK(wait_for([&] { return open.count("unsent: no peer") >= unsent + 10; }));
    CHECK(open.count("packets out") == sent);
    const Speaker next(open.address, SOCK_DGRAM);
    next.say(2);
    CHECK(wait_for([&] { return open.count("peers") == 2; }));
    CHECK(wait_for([&] {
      open.link->send(messages::refer_to(javiator::MotorSignals{}));
      open.link->flush();
      return next.hears();
    }));
  }

  TEST_CASE("a named peer whose port is closed is sent to all the same, for it may come again") {
    Descriptor closed(socket(AF_INET, SOCK_DGRAM, 0));
    REQUIRE(bind(closed.get(), any.get(), any.size()) == 0);
    const Address peer = any.with_port(port_of(closed));
    closed.close();
    Link link(std::make_unique<UdpTransport>(any, peer), javiator::message_set(), {});
    link.connect();
    const auto send = [&] {
      link.send(messages::refer_to(javiator::MotorSignals{}));
      link.flush();
    };
    CHECK(wait_for([&] { return send(), count_of(link, "closed ports") > 2; }));
    const Descriptor again(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0));
    REQUIRE(bind(again.get(), peer.get(), peer.size()) == 0);
    char room[64];
    CHECK(wait_for([&] { return send(), ::recv(again.get(), room, sizeof room, 0) > 0; }));
  }

  TEST_CASE("a flood of valid packets of a stranger keeps none of the peer's away") {
    const Open<UdpTransport> open;
    const Speaker peer(open.address, SOCK_DGRAM);
    peer.say(0);
    REQUIRE(wait_for([&] { return open.count("peers") == 1; }));
    std::atomic<bool> ending{false};
    std::thread flood([&] {
      const Speaker stranger(open.address, SOCK_DGRAM);
      const auto bytes = packet_of(60000);
      while (!ending) stranger.say(bytes);
    });
    REQUIRE(wait_for([&] { return open.count("dropped: stranger") > 100; }));
    constexpr int packets = 400;
    auto longest = 0ms;
    for (int id = 1; id <= packets; ++id) {
      const auto start = std::chrono::steady_clock::now();
      peer.say(id);
      if (id % 8 != 0) continue;  // some together, which wait in the peer's own room
      CHECK(wait_for([&] { return open.count("packets in") == static_cast<std::uint64_t>(id) + 1; }));
      longest = std::max(
          longest, std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - start));
    }
    ending = true;
    flood.join();
    Ids got;
    open.link->receive(got);
    CHECK(got.ids.size() == packets + 1);
    CHECK(std::count(got.ids.begin(), got.ids.end(), 60000) == 0);
    MESSAGE(open.count("dropped: stranger")
            << " of the stranger were looked at, " << open.count("dropped: no room in the system")
            << " had no room; a packet of the peer waited " << longest.count() << " ms at most");
  }

  TEST_CASE("a hello from a stray socket does not swallow the pilot's next command") {
    auto transport = std::make_unique<UdpTransport>(any, Address{});
    const UdpTransport& at = *transport;
    auto adapter = std::make_unique<Typed<JaviatorOperator>>();
    auto link = std::make_unique<Link>(std::move(transport), javiator::message_set(), LinkOptions{});
    LinkedSystem system(std::move(link), std::move(adapter));
    system.begin();
    const Address to = any.with_port(at.port());
    const Speaker pilot(to, SOCK_DGRAM), stray(to, SOCK_DGRAM);
    const auto packet = [](const auto& message) {
      const javiator::Header header;
      std::vector<std::byte> bytes;
      REQUIRE(
          write_packet(messages::refer_to(header), messages::refer_to(message), javiator::message_set().order, bytes));
      return bytes;
    };
    const auto command = [&](int altitude) {
      javiator::CommandData data;
      data.z = static_cast<std::int16_t>(altitude);
      return packet(data);
    };
    const auto count = [&](const std::string& name) {
      const LinkReport report = *system.link_report();
      for (const auto& [counted, value] : report.counts)
        if (counted == name) return value;
      return std::uint64_t{0};
    };
    tasks::PilotCommand pilot_command;
    pilot.say(command(1));  // its own hello
    REQUIRE(wait_for([&] { return count("packets in") == 1; }));
    system.reach(15ms);
    std::uint64_t heard = 1, dropped = 0;
    const auto say = [&](const Speaker& speaker, const std::vector<std::byte>& bytes) {
      speaker.say(bytes);
      ++(&speaker == &pilot ? heard : dropped);
      REQUIRE(wait_for([&] { return count("packets in") == heard && count("dropped: stranger") == dropped; }));
    };
    for (int i = 1; i <= 3; ++i) {
      say(stray, command(7));
      say(pilot, command(1000 * i));
      system.reach(15ms * (i + 1));
      system.take(0, &pilot_command);
      CHECK(pilot_command.altitude == doctest::Approx(i));
    }
    // the hello that the JAviator's terminal sends, and then the pilot's key
    for (unsigned i = 1; i <= 3; ++i) {
      say(stray, packet(javiator::SwitchState{}));
      system.reach(15ms * (2 * i + 3));
      system.take(0, &pilot_command);
      CHECK(pilot_command.state_switches == i - 1);
      say(pilot, packet(javiator::SwitchState{}));
      system.reach(15ms * (2 * i + 4));
      system.take(0, &pilot_command);
      CHECK(pilot_command.state_switches == i);
    }
    system.finish();
  }

  TEST_CASE("packets whose stamps can't be are dropped, each with its reason") {
    auto transport = std::make_unique<UdpTransport>(any, Address{});
    const UdpTransport& at = *transport;
    Link link(std::move(transport), imc::message_set(), {});
    link.connect();
    const Speaker speaker(any.with_port(at.port()), SOCK_DGRAM);
    const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    const auto say = [&](double stamp) {
      imc::Header header;
      header.src = 1;
      header.timestamp = stamp;
      std::vector<std::byte> bytes;
      REQUIRE(
          write_packet(messages::refer_to(header), messages::refer_to(imc::Depth{1}), imc::message_set().order, bytes));
      speaker.say(bytes);
    };
    say(now);
    for (int i = 0; i < 2; ++i) say(now + 86400);
    for (int i = 0; i < 3; ++i) say(now - 86400);
    say(std::numeric_limits<double>::quiet_NaN());
    say(now + 0.1);
    REQUIRE(wait_for([&] { return count_of(link, "packets in") == 8; }));
    CHECK(count_of(link, "dropped: stamp in the future") == 2);
    CHECK(count_of(link, "dropped: stamp in the past") == 3);
    CHECK(count_of(link, "dropped: stamp is no time") == 1);
    CHECK(count_of(link, "late") == 0);
    CHECK(link.report().heard == 2);
  }
}
