// Links with a key, and without one beside others that have it.
#include <doctest/doctest.h>

#include <algorithm>
#include <optional>

#include "distributers/links/seal.h"
#include "distributers/links/tcp.h"
#include "tests/distributers/links/open_link.h"

namespace {
using namespace jarol;
using namespace jarol::tests;
using namespace std::chrono_literals;
namespace javiator = messages::javiator;

SecretKey key_of(int seed) {
  SecretKey key{};
  key.fill(static_cast<std::byte>(seed));
  return key;
}
}  // namespace

TEST_SUITE("distributers/links/keys") {
  TEST_CASE("with a key both ends hear each other, and nobody else: UDP and TCP") {
    for (const bool udp : {true, false}) {
      CAPTURE(udp);
      LinkOptions sealed;
      sealed.key = key_of(1);
      const auto check = [&](const auto& open) {
        const auto dial = [&](std::optional<SecretKey> key) {
          std::unique_ptr<Transport> transport = std::make_unique<TcpClient>(open.address);
          if (udp) transport = std::make_unique<UdpTransport>(any, open.address);
          auto link = std::make_unique<Link>(std::move(transport), javiator::message_set(), LinkOptions{.key = key});
          link->connect();
          return link;
        };
        const auto say = [](Link& link, int id) {
          link.send(messages::refer_to(javiator::MotorSignals{0, 0, 0, 0, static_cast<std::uint16_t>(id)}));
          link.flush();
        };
        // one after the other: over TCP the second may else be turned away before it has said anything
        {
          const auto wrong = dial(key_of(2));
          CHECK(wait_for([&] { return say(*wrong, 60000), open.count("dropped: wrong key") > 0; }));
        }
        {
          const auto none = dial(std::nullopt);
          CHECK(wait_for([&] { return say(*none, 60001), open.count("dropped: without the key") > 0; }));
        }
        CHECK(open.link->report().heard == 0);
        CHECK(open.count("takeovers") == 0);
        for (int restart = 1; restart <= 3; ++restart) {
          const auto peer = dial(key_of(1));
          CHECK(wait_for([&] { return say(*peer, restart), open.count("packets in") >= 10U * restart; }));
          CHECK(wait_for([&] { return say(*open.link, restart), count_of(*peer, "packets in") > 0; }));
          peer->disconnect();
          CHECK(wait_for([&] {
            say(*open.link, 0);
            return open.count(udp ? "closed ports" : "ends of stream") >= static_cast<std::uint64_t>(restart);
          }));
        }
        Ids got;
        open.link->receive(got);
        CHECK(std::count(got.ids.begin(), got.ids.end(), 60000) == 0);
        CHECK(std::count(got.ids.begin(), got.ids.end(), 60001) == 0);
        // a packet that the greeting of its session overtook is as old as a replayed one: at most one each time
        CHECK(open.count("dropped: replayed") <= 3);
        CHECK(open.link->report().link.ends_with(" with a key"));
      };
      if (udp)
        check(Open<UdpTransport>(1h, sealed));
      else
        check(Open<TcpServer>(1h, sealed));
    }
  }

  TEST_CASE("a link without a key says of sealed packets that they are") {
    const Open<UdpTransport> datagrams;
    const Open<TcpServer> stream;
    Seal seal(key_of(1), "javiator");
    std::vector<std::byte> bytes;
    seal.seal(packet_of(1), bytes);
    Speaker(datagrams.address, SOCK_DGRAM).say(bytes);
    const Speaker connection(stream.address, SOCK_STREAM);
    connection.say(bytes);
    CHECK(wait_for([&] { return datagrams.count("dropped: sealed with a key") == 1; }));
    CHECK(wait_for([&] { return stream.count("dropped: sealed with a key") == 1; }));
    CHECK(wait_for([&] { return connection.is_ended(); }));
    CHECK(stream.count("packets in") == 0);
  }
}
