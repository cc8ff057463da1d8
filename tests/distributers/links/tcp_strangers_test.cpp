// Others than the peer, over TCP.
#include <doctest/doctest.h>

#include <atomic>
#include <vector>

#include "distributers/links/tcp.h"
#include "tests/distributers/links/open_link.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
using namespace jarol::tests;
namespace javiator = messages::javiator;

// Its thread looks at nobody until it may.
struct LateServer : TcpServer {
  using TcpServer::TcpServer;
  void receive(const Interrupter& interrupter, ByteSink& sink) override {
    while (!may_look && interrupter.wait(-1, 1ms) != Interrupter::Woken::interrupted) {}
    TcpServer::receive(interrupter, sink);
  }
  std::atomic<bool> may_look{false};
};
distributers::Descriptor bound_stream() {
  distributers::Descriptor made(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const auto any_port = distributers::Address::parse("127.0.0.1:0");
  REQUIRE(bind(made.get(), any_port.get(), any_port.size()) == 0);
  return made;
}
}  // namespace

TEST_SUITE("distributers/links/tcp_strangers") {
  TEST_CASE("over TCP a stray connection neither blocks nor replaces the one that speaks validly") {
    const Open<TcpServer> open;
    const Speaker mute(open.address, SOCK_STREAM);
    REQUIRE(wait_for([&] { return open.count("peers") == 1; }));
    const Speaker babbler(open.address, SOCK_STREAM);
    babbler.say(std::vector<std::byte>(100, std::byte{7}));
    const Speaker real(open.address, SOCK_STREAM);
    real.say(1);
    REQUIRE(wait_for([&] { return open.count("packets in") == 1; }));
    CHECK(wait_for([&] { return mute.is_ended() && babbler.is_ended(); }));
    for (int id = 2; id < 20; ++id) {
      const Speaker other(open.address, SOCK_STREAM);
      other.say(60000);
      CHECK(wait_for([&] { return other.is_ended(); }));
      real.say(id);
      REQUIRE(wait_for([&] { return open.count("packets in") == static_cast<std::uint64_t>(id); }));
    }
    CHECK_FALSE(real.is_ended());
    Ids got;
    open.link->receive(got);
    CHECK(got.ids.size() == 19);
    CHECK(std::count(got.ids.begin(), got.ids.end(), 60000) == 0);
    CHECK(open.count("dropped: stranger") == 20);
    CHECK(open.link->report().takeovers.empty());
  }

  TEST_CASE("of those who connect and speak before the link looks at any the first is heard, and keeps the link") {
    // whoever comes after it, however many
    for (const int others : {1, 7, 15}) {
      CAPTURE(others);
      auto transport = std::make_unique<LateServer>(any, 1h);
      LateServer& server = *transport;
      Link link(std::move(transport), javiator::message_set(), {});
      link.connect();
      const Address address = any.with_port(server.port());
      const Speaker first(address, SOCK_STREAM);
      first.say(1);
      std::vector<Speaker> late;
      for (int i = 0; i < others; ++i) late.emplace_back(address, SOCK_STREAM).say(60000);
      server.may_look = true;
      CHECK(wait_for([&] {
        return std::all_of(late.begin(), late.end(), [](const Speaker& other) { return other.is_ended(); });
      }));
      first.say(2);
      REQUIRE(wait_for([&] { return count_of(link, "packets in") == 2; }));
      Ids got;
      link.receive(got);
      CHECK(got.ids == std::vector<int>{1, 2});
      CHECK(count_of(link, "peers") == 1);
      CHECK(count_of(link, "dropped: stranger") == static_cast<std::uint64_t>(others));
    }
  }

  TEST_CASE("one that speaks validly is heard, however many have connected before and after it and say nothing") {
    auto transport = std::make_unique<LateServer>(any, 1h);
    LateServer& server = *transport;
    Link link(std::move(transport), javiator::message_set(), {});
    link.connect();
    const Address address = any.with_port(server.port());
    std::vector<Speaker> mute;
    for (int i = 0; i < 5; ++i) mute.emplace_back(address, SOCK_STREAM);
    const Speaker real(address, SOCK_STREAM);
    real.say(1);
    for (int i = 0; i < 10; ++i) mute.emplace_back(address, SOCK_STREAM);
    server.may_look = true;
    REQUIRE(wait_for([&] { return count_of(link, "packets in") == 1; }));
    CHECK(wait_for(
        [&] { return std::all_of(mute.begin(), mute.end(), [](const Speaker& other) { return other.is_ended(); }); }));
    CHECK_FALSE(real.is_ended());
  }

  TEST_CASE("over TCP a peer that has spoken and fallen silent gives way to one that speaks validly") {
    const Open<TcpServer> open(300ms);
    const Speaker first(open.address, SOCK_STREAM);
    first.say(1);
    REQUIRE(wait_for([&] { return open.count("packets in") == 1; }));
    std::this_thread::sleep_for(500ms);
    const Speaker mute(open.address, SOCK_STREAM);
    std::this_thread::sleep_for(500ms);
    CHECK_FALSE(first.is_ended());
    std::unique_ptr<Speaker> second;
    REQUIRE(wait_for([&] {
      // on a machine that halts a silence is longer, and the second is turned away
      if (!second || second->is_ended()) {
        second = std::make_unique<Speaker>(open.address, SOCK_STREAM);
        second->say(2);
        std::this_thread::sleep_for(200ms);
      }
      return open.count("packets in") == 2;
    }));
    CHECK(wait_for([&] { return first.is_ended(); }));
    const LinkReport report = open.link->report();
    REQUIRE(report.takeovers.size() == 1);
    CHECK(report.takeovers[0].from == first.name);
    CHECK(report.takeovers[0].to == second->name);
  }

  // The system gives who connects any free port: the one that he asks for, too.
  TEST_CASE("a socket that is connected to its own port is connected to itself, and is forgotten when it breaks off") {
    distributers::Descriptor self = bound_stream();
    const auto own = distributers::Address::parse("127.0.0.1:0").with_port(distributers::port_of(self));
    CHECK_FALSE(distributers::is_connected_to_itself(self));
    REQUIRE(connect(self.get(), own.get(), own.size()) == 0);
    CHECK(distributers::is_connected_to_itself(self));
    distributers::break_off(std::move(self));
    // a server may have the port at once
    const distributers::Descriptor server(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    CHECK(bind(server.get(), own.get(), own.size()) == 0);
    REQUIRE(listen(server.get(), 1) == 0);
    const distributers::Descriptor client(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    REQUIRE(connect(client.get(), own.get(), own.size()) == 0);
    CHECK_FALSE(distributers::is_connected_to_itself(client));
  }
}
