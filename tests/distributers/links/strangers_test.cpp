// Others than the peer, on real sockets: whoever speaks first, comes between, floods, or has no key.
#include <doctest/doctest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <random>
#include <thread>

#include "distributers/interfaces/typed.h"
#include "distributers/javiator/operator.h"
#include "distributers/links/linked.h"
#include "distributers/links/tcp.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "distributers/messages/packet.h"
#include "tests/distributers/links/raw_ends.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
using jarol::tests::count_of;
using jarol::tests::looked_at;
namespace imc = messages::imc;
namespace javiator = messages::javiator;

constexpr auto patience = 20s;  // a busy machine may take long
const Address any = Address::parse("127.0.0.1:0");

bool wait_for(const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

std::vector<std::byte> packet_of(int id) {
  const javiator::MotorSignals signals{0, 0, 0, 0, static_cast<std::uint16_t>(id)};
  const javiator::Header header;
  std::vector<std::byte> bytes;
  REQUIRE(write_packet(messages::refer_to(header), messages::refer_to(signals), javiator::message_set().order, bytes));
  return bytes;
}

struct Ids : messages::Receiver {
  void receive(messages::MessageRef message) override { ids.push_back(message.as<javiator::MotorSignals>()->id); }
  std::vector<int> ids;
};

template <class Listens>
std::unique_ptr<Listens> listening(std::chrono::nanoseconds silence) {
  if constexpr (std::is_same_v<Listens, UdpTransport>)
    return std::make_unique<UdpTransport>(any, Address{}, std::vector<Address>{}, silence);
  else
    return std::make_unique<Listens>(any, silence);
}

// A link that names no peer.
template <class Listens>
struct Open {
  explicit Open(std::chrono::nanoseconds silence = 1h, LinkOptions options = {}) {
    options.input = {PortKind::plain, 4096};
    auto transport = listening<Listens>(silence);
    const Listens& at = *transport;
    link = std::make_unique<Link>(std::move(transport), javiator::message_set(), options);
    link->connect();
    address = any.with_port(at.port());
  }
  std::uint64_t count(const std::string& name) const { return count_of(*link, name); }
  std::unique_ptr<Link> link;
  Address address;
};

// A socket that says what it is told to.
class Speaker {
 public:
  Speaker(const Address& to, int type) : socket_(::socket(AF_INET, type | SOCK_CLOEXEC, 0)) {
    REQUIRE(connect(socket_.get(), to.get(), to.size()) == 0);
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&storage), &size);
    name = Address::of(storage, size).text();
  }
  void say(std::span<const std::byte> bytes) const { ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL); }
  void say(int id) const { say(packet_of(id)); }
  bool hears() const {
    std::byte byte{};
    return ::recv(socket_.get(), &byte, 1, MSG_DONTWAIT | MSG_PEEK) > 0;
  }
  bool is_ended() const {
    char room[4096];
    ssize_t length = 0;
    while ((length = ::recv(socket_.get(), room, sizeof room, MSG_DONTWAIT)) > 0) {}
    return length == 0;
  }
  std::string name;

 private:
  Descriptor socket_;
};

// Its thread looks at nobody until it may.
struct LateServer : TcpServer {
  using TcpServer::TcpServer;
  void receive(const Interrupter& interrupter, ByteSink& sink) override {
    while (!may_look && interrupter.wait(-1, 1ms) != Interrupter::Woken::interrupted) {}
    TcpServer::receive(interrupter, sink);
  }
  std::atomic<bool> may_look{false};
};

SecretKey key_of(int seed) {
  SecretKey key{};
  key.fill(static_cast<std::byte>(seed));
  return key;
}
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
    CHECK(wait_for([&] {
      second.say(2);
      return open.count("packets in") > 1;
    }));
    const LinkReport report = open.link->report();
    REQUIRE(report.takeovers.size() == 1);
    CHECK(report.takeovers[0].from == first.name);
    CHECK(report.takeovers[0].to == second.name);
    CHECK(report.takeovers[0].at >= 300ms);
    CHECK(open.count("takeovers") == 1);
    CHECK(open.count("peers") == 2);
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
    REQUIRE(wait_for([&] { return open.count("closed ports") == 1; }));
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
    LinkedChannels channels(std::move(link), std::move(adapter));
    channels.begin();
    const Address to = any.with_port(at.port());
    const Speaker pilot(to, SOCK_DGRAM), stray(to, SOCK_DGRAM);
    const auto command = [](int altitude) {
      javiator::CommandData data;
      data.z = static_cast<std::int16_t>(altitude);
      const javiator::Header header;
      std::vector<std::byte> bytes;
      REQUIRE(write_packet(messages::refer_to(header), messages::refer_to(data), javiator::message_set().order, bytes));
      return bytes;
    };
    const auto count = [&](const std::string& name) {
      const LinkReport report = *channels.link_report();
      for (const auto& [counted, value] : report.counts)
        if (counted == name) return value;
      return std::uint64_t{0};
    };
    tasks::PilotCommand pilot_command;
    pilot.say(command(1));  // its own hello
    REQUIRE(wait_for([&] { return count("packets in") == 1; }));
    channels.reach(15ms);
    for (int i = 1; i <= 3; ++i) {
      stray.say(command(7));
      REQUIRE(wait_for([&] { return count("dropped: stranger") == static_cast<std::uint64_t>(i); }));
      pilot.say(command(1000 * i));
      REQUIRE(wait_for([&] { return count("packets in") == static_cast<std::uint64_t>(i) + 1; }));
      channels.reach(15ms * (i + 1));
      channels.take(0, &pilot_command);
      CHECK(pilot_command.altitude == doctest::Approx(i));
    }
    channels.finish();
  }

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
