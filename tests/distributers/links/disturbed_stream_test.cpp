// Streams that are cut up, held up and damaged on their way: what was not hit arrives, and nothing else.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "distributers/links/serial.h"
#include "distributers/links/tcp.h"
#include "distributers/messages/payload.h"
#include "tests/distributers/links/raw_ends.h"
#include "tests/distributers/links/stream_proxy.h"
#include "tests/distributers/messages/damage.h"
#include "tests/how_many.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace jarol::messages;
using namespace jarol::tests;
using namespace std::chrono_literals;

// A link, the proxy before it, and what writes into that.
class Route {
 public:
  Route(const std::string& kind, const MessageSet& set, const Disturbance& disturbance) {
    const Address any = Address::parse("127.0.0.1:0");
    if (kind == "serial") {
      auto line = std::make_unique<SerialProxy>(disturbance, 5);
      end_ = Descriptor(::open(line->name(0).c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
      termios settings{};
      tcgetattr(end_.get(), &settings);
      cfmakeraw(&settings);
      tcsetattr(end_.get(), TCSANOW, &settings);
      connect(std::make_unique<SerialTransport>(line->name(1), 115200), set);
      proxy = std::move(line);
      while (count_of(*link, "peers") == 0) std::this_thread::sleep_for(1ms);
    } else if (kind == "tcp_server") {
      auto transport = std::make_unique<TcpServer>(any);
      const TcpServer& server = *transport;
      connect(std::move(transport), set);
      auto between = std::make_unique<TcpProxy>(any.with_port(server.port()), disturbance, 5);
      end_ = Descriptor(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
      const Address to = any.with_port(between->port());
      REQUIRE(::connect(end_.get(), to.get(), to.size()) == 0);
      proxy = std::move(between);
    } else {
      const Descriptor listens = listen_at(any);
      auto between = std::make_unique<TcpProxy>(any.with_port(port_of(listens)), disturbance, 4);
      connect(std::make_unique<TcpClient>(any.with_port(between->port())), set);
      pollfd polled{listens.get(), POLLIN, 0};
      REQUIRE(poll(&polled, 1, 20'000) == 1);
      end_ = accept_from(listens);
      fcntl(end_.get(), F_SETFL, 0);
      from_end = 1;
      proxy = std::move(between);
    }
  }

  void write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const auto length = ::write(end_.get(), bytes.data(), bytes.size());
      REQUIRE(length > 0);
      bytes = bytes.subspan(static_cast<std::size_t>(length));
    }
  }

  std::unique_ptr<StreamProxy> proxy;
  std::size_t from_end = 0;
  std::unique_ptr<Link> link;

 private:
  void connect(std::unique_ptr<Transport> transport, const MessageSet& set) {
    // what is sent was recorded over ten minutes, and is sent in any order: no limit to stamps
    link = std::make_unique<Link>(
        std::move(transport), set,
        LinkOptions{.input = {PortKind::plain, 4096}, .output = {}, .header = {}, .silence = 0ns});
    link->connect();
  }
  Descriptor end_;
};

// What was in the packets that a link gave.
struct Payloads : Receiver {
  explicit Payloads(ByteOrder its) : order(its) {}
  void receive(MessageRef message) override {
    Bytes payload;
    REQUIRE(write_payload(message, order, payload));
    all.push_back(payload);
  }
  ByteOrder order;
  std::vector<Bytes> all;
};

struct SentThrough {
  std::size_t sent = 0, hit = 0;  // packets
  std::vector<Bytes> due, came;   // payloads
  std::uint64_t bytes = 0;        // written
  ProxyCounts counts;
};

// Sends recorded packets, and so many zeros behind them.
SentThrough send_through(Route& route, const Protocol& protocol, std::size_t count, std::size_t zeros) {
  const MessageSet& set = protocol.set;
  std::vector<Bytes> packets = protocol.packets();
  std::erase_if(packets, [&](const Bytes& bytes) { return order_of(set, bytes.data()) != set.order; });
  Random random(6);
  Payloads payloads(set.order);
  SentThrough o;
  std::vector<std::uint64_t> ends;
  std::vector<Bytes> sent;
  for (; o.sent < count; ++o.sent) {
    const Bytes& packet = packets[below(random, packets.size())];
    route.write(packet);
    ends.push_back(o.bytes += packet.size());
    sent.emplace_back(packet.begin() + static_cast<std::ptrdiff_t>(set.header_size()),
                      packet.end() - static_cast<std::ptrdiff_t>(set.footer_size()));
    route.link->receive(payloads);
  }
  route.write(Bytes(zeros));
  o.bytes += zeros;
  const auto done = [&] {
    o.counts = route.proxy->from(route.from_end);
    // the last zero might be the first of a sync
    const bool all_seen =
        o.counts.in == o.bytes && o.counts.in == o.counts.lost + o.counts.out &&
        count_of(*route.link, "bytes in") + count_of(*route.link, "bytes dropped") + (zeros > 0 ? 1 : 0) ==
            o.counts.out;
    route.link->receive(payloads);
    return all_seen;
  };
  for (const auto end = std::chrono::steady_clock::now() + 120s; !done();) {
    REQUIRE(std::chrono::steady_clock::now() < end);
    std::this_thread::sleep_for(1ms);
  }
  const std::vector<std::uint64_t> hit = route.proxy->hit(route.from_end);
  auto at = hit.begin();
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto next = std::lower_bound(at, hit.end(), ends[i]);
    if (next == at) o.due.push_back(sent[i]);
    if (next != at) ++o.hit;
    at = next;
  }
  o.came = std::move(payloads.all);
  return o;
}

// All of the first are among the second, in their order.
bool is_within(const std::vector<Bytes>& due, const std::vector<Bytes>& came) {
  auto next = due.begin();
  for (const Bytes& payload : came)
    if (next != due.end() && payload == *next) ++next;
  return next == due.end();
}

void check_cut(const std::string& kind) {
  for (const Protocol& protocol : protocols()) {
    Route route(kind, protocol.set, {.delay = 100us, .longest_piece = 1});
    const SentThrough o = send_through(route, protocol, is_full() ? 1000 : 80, 0);
    CHECK(o.hit == 0);
    CHECK(o.came == o.due);
    CHECK(o.counts.lost == 0);
    CHECK(flawed(*route.link) == 0);
    MESSAGE(kind << ", " << std::string(protocol.set.name) << ": " << o.came.size() << " of " << o.sent
                 << " packets came, in " << o.bytes << " pieces");
  }
}
}  // namespace

TEST_SUITE("distributers/links/disturbed_stream") {
  TEST_CASE("packets that come byte by byte, each byte late, are all there: TCP client") { check_cut("tcp_client"); }
  TEST_CASE("packets that come byte by byte, each byte late, are all there: TCP server") { check_cut("tcp_server"); }
  TEST_CASE("packets that come byte by byte, each byte late, are all there: serial line") { check_cut("serial"); }

  TEST_CASE("lost and damaged bytes cost the packets that they hit, which are counted, and no others: serial line") {
    for (const Protocol& protocol : protocols()) {
      Route route("serial", protocol.set, {.loss = 0.005, .damage = 0.005, .longest_piece = 4});
      const MessageSet& set = protocol.set;
      // a length that is wrong makes it wait for as many bytes
      const std::size_t longest = set.header_size() + set.max_payload + set.footer_size();
      const SentThrough o = send_through(route, protocol, is_full() ? 200'000 : 3000, longest);
      CHECK(o.hit > o.sent / 10);
      CHECK(is_within(o.due, o.came));
      // two bytes damaged in one packet may leave the sum right
      const std::size_t sealed = o.came.size() - o.due.size();
      CHECK(sealed <= o.hit / 1000);
      CHECK(count_of(*route.link, "packets in") == o.came.size());
      const std::uint64_t dropped = flawed(*route.link);
      CHECK(dropped > o.hit * 9 / 10);
      CHECK(dropped < o.hit * 11 / 10);
      MESSAGE("serial, " << std::string(protocol.set.name) << ": " << o.counts.lost << " bytes lost and "
                         << o.counts.damaged << " damaged of " << o.bytes << ", " << o.hit << " of " << o.sent
                         << " packets hit, " << o.came.size() << " came, " << sealed
                         << " of those hit had the right checksum, " << dropped << " dropped");
    }
  }
}
