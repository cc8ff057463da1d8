// A link with places for several peers, over real sockets: who comes, leaves, falls silent and floods.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <thread>

#include "distributers/links/udp.h"
#include "distributers/messages/javiator.h"
#include "tests/distributers/links/open_link.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
using namespace jarol::tests;

struct Several {
  explicit Several(std::size_t places, std::chrono::nanoseconds silence = 1h) {
    auto transport = std::make_unique<UdpTransport>(any, Address{}, std::vector<Address>{}, silence, places);
    const UdpTransport& at = *transport;
    LinkOptions options;
    options.input = {PortKind::plain, 4096};
    link = std::make_unique<Link>(std::move(transport), messages::javiator::message_set(), options);
    link->connect();
    address = any.with_port(at.port());
  }
  Speaker speaker() const { return {address, SOCK_DGRAM}; }
  std::uint64_t count(const std::string& name) const { return count_of(*link, name); }
  void send(int id) const { send_id(*link, id); }
  // Says something, and waits until it is taken.
  void hear(const Speaker& from, int id) const {
    const std::uint64_t before = count("packets in");
    from.say(id);
    REQUIRE(wait_for([&] { return count("packets in") == before + 1; }));
  }
  void let_in(const Speaker& from, int id) const {
    const std::uint64_t before = count("peers");
    hear(from, id);
    REQUIRE(wait_for([&] { return count("peers") == before + 1; }));
  }
  std::uint32_t number_of_last() const {
    Ids got;
    link->receive(got);
    REQUIRE_FALSE(got.ids.empty());
    return link->peer();
  }
  std::unique_ptr<Link> link;
  Address address;
};
}  // namespace

TEST_SUITE("distributers/links/several_peers") {
  TEST_CASE("what is sent goes to all peers, and what each of them says counts; one more is a stranger") {
    const Several two(2);
    const Speaker one = two.speaker(), other = two.speaker(), third = two.speaker();
    two.let_in(one, 1);
    two.let_in(other, 2);
    for (int i = 0; i < 5; ++i) third.say(100);
    REQUIRE(wait_for([&] { return two.count("dropped: stranger") == 5; }));
    two.hear(one, 3);
    two.hear(other, 4);
    Ids got;
    two.link->receive(got);
    CHECK(got.ids == std::vector{1, 2, 3, 4});
    for (int id = 0; id < 10; ++id) two.send(id);
    std::vector<int> expected;
    for (int id = 0; id < 10; ++id) expected.push_back(id);
    CHECK(one.ids(10) == expected);
    CHECK(other.ids(10) == expected);
    CHECK_FALSE(third.hears());
    CHECK(two.count("packets out") == 10);
    CHECK(two.count("unsent: no peer") == 0);
    const LinkReport report = two.link->report();
    REQUIRE(report.peers.size() == 2);
    CHECK(report.peers[0].address == one.name);
    CHECK(report.peers[0].packets == 2);
    CHECK(report.peers[1].address == other.name);
    CHECK(report.peers[1].packets == 2);
    REQUIRE(report.strangers.size() == 1);
    CHECK(report.strangers[0].address == third.name);
    CHECK(report.strangers[0].times == 5);
  }

  TEST_CASE("one whose port is closed leaves, and comes again from another; the other hears all and notices nothing") {
    const Several two(2);
    const Speaker stays = two.speaker();
    std::optional<Speaker> leaves(two.speaker());
    two.let_in(stays, 1);
    two.let_in(*leaves, 2);
    leaves->say(3);  // the last that it says counts, too
    leaves.reset();
    REQUIRE(wait_for([&] { return two.count("packets in") == 3; }));
    int sent = 0;
    CHECK(wait_for([&] { return two.send(sent++), two.count("closed ports") == 1; }));
    CHECK(wait_for([&] { return two.count("packets out") == static_cast<std::uint64_t>(sent); }));
    two.hear(stays, 4);
    CHECK(two.number_of_last() == 1);
    const Speaker again = two.speaker();
    two.let_in(again, 5);
    CHECK(two.number_of_last() == 1);
    two.send(sent++);
    CHECK(again.ids(1) == std::vector{sent - 1});
    std::vector<int> expected;
    for (int id = 0; id < sent; ++id) expected.push_back(id);
    CHECK(stays.ids(expected.size()) == expected);
    CHECK(two.count("takeovers") == 0);
    CHECK(two.count("dropped: stranger") == 0);
    CHECK(two.link->report().peers.size() == 3);
  }

  TEST_CASE("one that is silent gives its place to the next, which is reported; who goes on speaking keeps its own") {
    const Several two(2, 300ms);
    const Speaker silent = two.speaker(), speaks = two.speaker(), next = two.speaker();
    two.let_in(silent, 1);
    two.let_in(speaks, 2);
    CHECK(wait_for([&] {
      speaks.say(3);
      next.say(4);
      return two.count("peers") == 3;
    }));
    two.send(7);
    CHECK(next.ids(1) == std::vector{7});
    CHECK(speaks.ids(1) == std::vector{7});
    CHECK_FALSE(silent.hears());
    const LinkReport report = two.link->report();
    REQUIRE(report.takeovers.size() == 1);
    CHECK(report.takeovers[0].from == silent.name);
    CHECK(report.takeovers[0].to == next.name);
    CHECK(report.takeovers[0].at >= 300ms);
    CHECK(two.number_of_last() == 1);
  }

  TEST_CASE("a link has lost its peers when the last has gone: who comes then is another than before") {
    const Several three(3);
    {
      const Speaker one = three.speaker(), other = three.speaker();
      three.let_in(one, 1);
      CHECK(three.number_of_last() == 1);
      three.let_in(other, 2);
      CHECK(three.number_of_last() == 1);
      three.hear(one, 3);
      CHECK(three.number_of_last() == 1);
    }
    CHECK(wait_for([&] { return three.send(0), three.count("closed ports") == 2; }));
    CHECK(wait_for([&] { return three.send(0), three.count("unsent: no peer") > 0; }));
    const Speaker next = three.speaker();
    three.let_in(next, 4);
    CHECK(three.number_of_last() == 2);
  }

  TEST_CASE("a flood, of a stranger or of garbage while a place is free, keeps nothing of any peer away") {
    for (const bool is_full : {true, false}) {
      CAPTURE(is_full);
      const Several link(is_full ? 3 : 4);
      const Speaker peers[] = {link.speaker(), link.speaker(), link.speaker()};
      for (const Speaker& peer : peers) link.let_in(peer, 0);
      std::atomic<bool> ending{false};
      std::thread flood([&] {
        const Speaker stranger = link.speaker();
        auto bytes = packet_of(60000);
        if (!is_full) bytes.back() ^= std::byte{1};
        while (!ending) stranger.say(bytes);
      });
      REQUIRE(wait_for([&] { return link.count("dropped: stranger") + flawed(*link.link) > 100; }));
      constexpr std::uint64_t packets = 200;
      for (std::uint64_t id = 1; id <= packets; ++id) {
        for (const Speaker& peer : peers) peer.say(static_cast<int>(id));
        if (id % 8 == 0) CHECK(wait_for([&] { return link.count("packets in") == 3 + 3 * id; }));
      }
      // at the door little is looked at meanwhile
      const auto looked = [&] { return link.count("dropped: stranger") + flawed(*link.link); };
      const std::uint64_t before = looked();
      std::this_thread::sleep_for(500ms);
      CHECK(looked() - before < 5000);
      ending = true;
      flood.join();
      Ids got;
      link.link->receive(got);
      CHECK(got.ids.size() == 3 + 3 * packets);
      CHECK(std::count(got.ids.begin(), got.ids.end(), 60000) == 0);
      CHECK(link.count("peers") == 3);
    }
  }

  TEST_CASE("sixteen are served at once") {
    const Several link(Ownership::max_places);
    std::vector<Speaker> peers;
    for (int i = 0; i < 16; ++i) link.let_in(peers.emplace_back(link.speaker()), i);
    for (int round = 0; round < 20; ++round)
      for (const Speaker& peer : peers) peer.say(round);
    CHECK(wait_for([&] { return link.count("packets in") == 16 + 16 * 20; }));
    link.send(5);
    for (const Speaker& peer : peers) CHECK(peer.ids(1) == std::vector{5});
    CHECK(link.count("dropped: stranger") == 0);
    CHECK(link.link->report().peers.size() == 16);
  }
}
