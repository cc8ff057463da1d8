// What links refuse, drop and count, who sent a packet, and what adapters learn of peers.
#include <doctest/doctest.h>

#include "distributers/interfaces/typed.h"
#include "distributers/links/linked.h"
#include "distributers/links/serial.h"
#include "distributers/links/tcp.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"
#include "tests/distributers/links/pairs.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace jarol::tests;
using namespace std::chrono_literals;
namespace imc = messages::imc;
namespace javiator = messages::javiator;

// What it learns, in order.
struct Diary {
  [[maybe_unused]] static constexpr std::string_view summary = "keeps what it is called for";
  [[maybe_unused]] static constexpr bool is_vehicle = false;
  static const messages::MessageSet& message_set() { return javiator::message_set(); }
  static constexpr auto handlers() { return handle(on<javiator::MotorSignals>(&Diary::motors)); }
  void motors(const javiator::MotorSignals& m) { text += std::to_string(m.id) + " "; }
  void peer_changed() { text += "peer "; }
  void finish() { text += "end "; }
  static inline std::string text;
};
}  // namespace

TEST_SUITE("distributers/links/counts") {
  TEST_CASE("a plain output port refuses when it is full, and that is counted") {
    const auto link = make(std::make_unique<UdpTransport>(Address::parse("127.0.0.1:0"), Address{}),
                           {.input = {}, .output = {PortKind::plain, 4}, .header = {}});
    // not connected: nobody empties the port
    for (int id = 0; id < 50; ++id) link->send(messages::refer_to(javiator::MotorSignals{}));
    CHECK(count_of(*link, "unsent: output port full") == 46);
    // the sender takes what is in it, though nobody has spoken and it has no peer; then there is room again
    link->connect();
    CHECK(wait_for([&] { return count_of(*link, "unsent: no peer") == 4; }));
    send_id(*link, 50);
    CHECK(wait_for([&] { return count_of(*link, "unsent: no peer") == 5; }));
    CHECK(count_of(*link, "unsent: output port full") == 46);
  }

  TEST_CASE("a push port keeps the newest packets; those overwritten are counted") {
    Pair pair = udp("127.0.0.1", {.input = {PortKind::push, 4}, .output = {}, .header = {}});
    for (int id = 0; id < 50; ++id) send_id(*pair.other, id);
    REQUIRE(wait_for([&] { return count_of(*pair.one, "packets in") == 50; }));
    Ids got;
    pair.one->receive(got);
    CHECK(got.ids == std::vector<int>{46, 47, 48, 49});
    CHECK(count_of(*pair.one, "dropped: overwritten by newer") == 46);
  }

  TEST_CASE("what is no valid packet is dropped, counted by reason, and makes nobody the peer") {
    Pair pair = udp("127.0.0.1");
    const Descriptor stranger(socket(AF_INET, SOCK_DGRAM, 0));
    const Address to =
        Address::parse("127.0.0.1:" + std::to_string(static_cast<const UdpTransport&>(pair.one->transport()).port()));
    const auto throw_in = [&](const std::vector<unsigned char>& bytes) {
      REQUIRE(sendto(stranger.get(), bytes.data(), bytes.size(), 0, to.get(), to.size()) ==
              static_cast<ssize_t>(bytes.size()));
    };
    throw_in({});
    throw_in({1, 2, 3});
    throw_in({0xff, 0xff, 0x11, 0, 0, 0x12});  // a wrong checksum
    throw_in({0xff, 0xff, 0x11, 9, 0, 0x11});  // nine bytes of payload that are not there
    throw_in({1, 2, 3, 4, 5, 6});
    throw_in({0xff, 0xff, 0x11, 0, 0, 0x11, 7});  // a byte too many
    throw_in({0xff, 0xff, 0x11, 1, 7, 0, 0x19});  // a payload where its message has none
    throw_in({0xff, 0xff, 0x63, 0, 0, 0x63});     // no message has this id
    REQUIRE(wait_for([&] { return count_of(*pair.one, "dropped: unknown id") == 1; }));
    CHECK(count_of(*pair.one, "dropped: truncated") == 3);
    CHECK(count_of(*pair.one, "dropped: bad checksum") == 1);
    CHECK(count_of(*pair.one, "dropped: garbage") == 1);
    CHECK(count_of(*pair.one, "dropped: oversized") == 1);
    CHECK(count_of(*pair.one, "dropped: bad payload") == 1);
    CHECK(count_of(*pair.one, "packets in") == 0);
    CHECK(count_of(*pair.one, "peers") == 0);
    Ids got;
    pair.one->receive(got);
    CHECK(got.ids.empty());
    throw_in({0xff, 0xff, 0x11, 0, 0, 0x11});
    CHECK(wait_for([&] { return count_of(*pair.one, "peers") == 1; }));
  }

  TEST_CASE("who sent a datagram is reported with it, however many wait together; streams do not report") {
    struct Senders : messages::Receiver {
      explicit Senders(const Link& from) : link(from) {}
      void receive(messages::MessageRef) override { peers.push_back(link.peer()); }
      const Link& link;
      std::vector<std::uint32_t> peers;
    };
    Pair pair = udp("127.0.0.1");
    const Address to =
        Address::parse("127.0.0.1:" + std::to_string(static_cast<const UdpTransport&>(pair.one->transport()).port()));
    for (std::uint64_t i = 0; i < 4; ++i) {
      auto peer = make(std::make_unique<UdpTransport>(Address::parse("127.0.0.1:0"), to));
      peer->connect();
      for (int packet = 0; packet < 2; ++packet) send_id(*peer, 1);
      REQUIRE(wait_for([&] { return count_of(*pair.one, "packets in") == 2 * (i + 1); }));
      peer.reset();
      REQUIRE(wait_for([&] {
        send_id(*pair.one, 1);  // finds its port closed
        return count_of(*pair.one, "closed ports") == i + 1;
      }));
    }
    Senders senders(*pair.one);
    pair.one->receive(senders);
    CHECK(senders.peers == std::vector<std::uint32_t>{1, 1, 2, 2, 3, 3, 4, 4});

    Pair streams = tcp("127.0.0.1");
    REQUIRE(meet(streams));
    CHECK(streams.one->peer() == 0);
  }

  TEST_CASE("packets that come after one that their sender stamped later are late; they are taken all the same") {
    auto transport = std::make_unique<UdpTransport>(Address::parse("127.0.0.1:0"), Address{});
    const UdpTransport& at = *transport;
    Link link(std::move(transport), imc::message_set(), {.input = {}, .output = {}, .header = {}});
    link.connect();
    const Address to = Address::parse("127.0.0.1:" + std::to_string(at.port()));
    const Descriptor one(socket(AF_INET, SOCK_DGRAM, 0));
    std::uint64_t sent = 0;
    const auto throw_in = [&](const Descriptor& from, std::uint16_t source, double time) {
      imc::Header header;
      header.src = source;
      header.timestamp = time;
      std::vector<std::byte> bytes;
      REQUIRE(write_packet(messages::refer_to(header), messages::refer_to(imc::Depth{1}), messages::ByteOrder::little,
                           bytes));
      REQUIRE(sendto(from.get(), bytes.data(), bytes.size(), 0, to.get(), to.size()) > 0);
      ++sent;
      REQUIRE(wait_for([&] { return count_of(link, "packets in") == sent; }));
      return count_of(link, "late");
    };
    CHECK(throw_in(one, 1, 10) == 0);
    CHECK(throw_in(one, 1, 12) == 0);
    CHECK(throw_in(one, 1, 11) == 1);
    CHECK(throw_in(one, 1, 12) == 1);  // doubled
    CHECK(throw_in(one, 1, 11.5) == 2);
    CHECK(throw_in(one, 2, 3) == 2);  // has a clock of its own
    CHECK(throw_in(one, 2, 2) == 3);
    struct Taken : messages::Receiver {
      void receive(messages::MessageRef) override { ++count; }
      std::uint64_t count = 0;
    } taken;
    link.receive(taken);
    CHECK(taken.count == sent);
  }

  TEST_CASE("an adapter learns of a new peer before its first packet, and of the end") {
    auto transport = std::make_unique<UdpTransport>(Address::parse("127.0.0.1:0"), Address{});
    const UdpTransport& at = *transport;
    std::string& diary = Diary::text;
    auto made = make(std::move(transport));
    Link& link = *made;
    LinkedSystem system(std::move(made), std::make_unique<Typed<Diary>>());
    system.begin();
    const Address to = Address::parse("127.0.0.1:" + std::to_string(at.port()));
    for (int restart = 0; restart < 2; ++restart) {
      const auto peer = make(std::make_unique<UdpTransport>(Address::parse("127.0.0.1:0"), to));
      peer->connect();
      for (int id = 1; id <= 2; ++id) send_id(*peer, 10 * restart + id);
      REQUIRE(wait_for([&] { return at.counts.connected == static_cast<std::uint64_t>(restart + 1); }));
      peer->disconnect();
      REQUIRE(wait_for([&] {
        send_id(link, 1);
        return at.counts.closed == static_cast<std::uint64_t>(restart + 1);
      }));
    }
    REQUIRE(wait_for([&] {
      system.reach(Duration{});
      return diary.find("12") != std::string::npos;
    }));
    CHECK(diary == "peer 1 2 peer 11 12 ");
    system.finish();
    CHECK(diary == "peer 1 2 peer 11 12 end ");
  }

  TEST_CASE("with a peer named, datagrams of others are strangers") {
    Pair pair = udp("127.0.0.1");
    const Descriptor stranger(socket(AF_INET, SOCK_DGRAM, 0));
    const Address to =
        Address::parse("127.0.0.1:" + std::to_string(static_cast<const UdpTransport&>(pair.other->transport()).port()));
    const unsigned char bytes[] = {0xff, 0xff, 0x11, 0, 0, 0x11};
    sendto(stranger.get(), bytes, sizeof bytes, 0, to.get(), to.size());
    CHECK(wait_for([&] { return count_of(*pair.other, "dropped: stranger") == 1; }));
    CHECK(count_of(*pair.other, "packets in") == 0);
  }

  TEST_CASE("garbage within a stream is passed over, and what follows is read") {
    Pair pair = tcp("127.0.0.1");
    REQUIRE(meet(pair));
    const int port = static_cast<const TcpServer&>(pair.one->transport()).port();
    const Descriptor raw(socket(AF_INET, SOCK_STREAM, 0));
    const Address to = Address::parse("127.0.0.1:" + std::to_string(port));
    pair.other->disconnect();
    REQUIRE(wait_for([&] { return count_of(*pair.one, "ends of stream") == 1; }));  // or it would keep its place
    REQUIRE(connect(raw.get(), to.get(), to.size()) == 0);
    const unsigned char bytes[] = {7, 7, 7, 0xff, 0xff, 0x05, 0x0a, 0, 1, 0, 2, 0, 3, 0, 4, 0, 42, 0, 0x43, 9, 9};
    REQUIRE(::write(raw.get(), bytes, sizeof bytes) == sizeof bytes);
    Ids got;
    CHECK(wait_for([&] {
      pair.one->receive(got);
      return !got.ids.empty() && got.ids.back() == 42;
    }));
    CHECK(wait_for([&] { return count_of(*pair.one, "dropped: garbage") >= 1; }));
  }

  TEST_CASE("in a stream, too, what is dropped is counted by reason; of what the end cut off, when the next begins") {
    auto transport = std::make_unique<TcpServer>(Address::parse("127.0.0.1:0"));
    const TcpServer& server = *transport;
    const auto link = make(std::move(transport));
    link->connect();
    const Address to = Address::parse("127.0.0.1:" + std::to_string(server.port()));
    const std::vector<unsigned char> streams[] = {
        {0xff, 0xff, 0x11, 0xff, 0xff, 0, 0, 0, 0, 0},  // more payload than any message has
        {0xff, 0xff, 0x11, 0, 0, 0x12, 0xff, 0xff, 0x63, 0, 0, 0x63, 0xff, 0xff, 0x11, 0, 0, 0x11},
        {0xff, 0xff, 0x05, 0x0a, 0, 1, 0},  // its message goes on
        {0xff, 0xff, 0x11, 0, 0, 0x11}};
    for (std::uint64_t i = 0; i < 4; ++i) {
      const Descriptor raw(socket(AF_INET, SOCK_STREAM, 0));
      REQUIRE(connect(raw.get(), to.get(), to.size()) == 0);
      REQUIRE(::write(raw.get(), streams[i].data(), streams[i].size()) == static_cast<ssize_t>(streams[i].size()));
      shutdown(raw.get(), SHUT_WR);
      REQUIRE(wait_for([&] { return count_of(*link, "ends of stream") == i + 1; }));
    }
    CHECK(count_of(*link, "dropped: oversized") == 1);
    CHECK(count_of(*link, "dropped: bad checksum") == 1);
    CHECK(count_of(*link, "dropped: unknown id") == 1);
    CHECK(count_of(*link, "dropped: truncated") == 1);
    CHECK(count_of(*link, "packets in") == 2);
  }

  TEST_CASE("one look takes no more packets than the port holds, though others come meanwhile") {
    struct Feeds : messages::Receiver {
      explicit Feeds(Pair& its) : pair(its) {}
      void receive(messages::MessageRef) override {
        const std::uint64_t before = count_of(*pair.one, "packets in");
        if (++given > 10) return;
        send_id(*pair.other, 0);
        CHECK(wait_for([&] { return count_of(*pair.one, "packets in") > before; }));
      }
      Pair& pair;
      int given = 0;
    };
    for (const PortKind kind : {PortKind::plain, PortKind::push}) {
      Pair pair = udp("127.0.0.1", {.input = {kind, 4}, .output = {}, .header = {}});
      send_id(*pair.other, 0);
      REQUIRE(wait_for([&] { return count_of(*pair.one, "packets in") == 1; }));
      Feeds feeds(pair);
      pair.one->receive(feeds);
      CHECK(feeds.given == 4);
    }
  }

  TEST_CASE("what can't be had from the begin is an error that says why") {
    Pair pair = udp("127.0.0.1");
    const int port = static_cast<const UdpTransport&>(pair.one->transport()).port();
    const std::string at = "127.0.0.1:" + std::to_string(port);
    const auto second = make(std::make_unique<UdpTransport>(Address::parse(at), Address{}));
    CHECK_THROWS_WITH(second->connect(), ("can't listen at udp " + at + ": Address already in use").c_str());
    const auto line = make(std::make_unique<SerialTransport>("/dev/no_such_line", 9600));
    CHECK_THROWS_WITH(line->connect(), "can't open serial /dev/no_such_line at 9600 baud: No such file or directory");
    CHECK_THROWS_WITH(
        SerialTransport("/dev/ttyS0", 12345),
        "no serial line has 12345 baud; there are: 9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600");
  }

  TEST_CASE("an address that can't be is reported with what would be right") {
    const std::string forms = "; write it as in 7000, 192.168.2.3:7000 or \"[::1]:7000\"";
    for (const char* bad : {"", "x", "70000", "127.0.0.1:", "::1:7000", ":7000", "127.0.0.1:-1"}) {
      CAPTURE(bad);
      CHECK_THROWS_WITH(Address::parse(bad),
                        ("'" + std::string(bad) + "' is not an address with a port" + forms).c_str());
    }
    CHECK(Address::parse("7000").text() == "127.0.0.1:7000");
    CHECK(Address::parse("[::1]:7000").text() == "[::1]:7000");
    CHECK(Address::parse("192.168.2.3:1").text() == "192.168.2.3:1");
  }
}
