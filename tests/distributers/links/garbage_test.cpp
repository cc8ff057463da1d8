// Random and damaged packets on every kind of link: nothing crashes, and what comes out is what had the right checksum.
#include <doctest/doctest.h>

#include <chrono>
#include <deque>
#include <thread>

#include "distributers/messages/payload.h"
#include "tests/distributers/links/raw_ends.h"
#include "tests/distributers/messages/damage.h"
#include "tests/how_many.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace jarol::messages;
using namespace jarol::tests;
using namespace std::chrono_literals;

// of each sort on each kind of link, shared by the message sets
std::size_t packet_count() { return tests::how_many(2'000, 1'000'000); }

struct Expected {
  std::uint32_t id = 0;
  ByteOrder order = ByteOrder::little;
  Bytes payload;
};

// What ought to come out of the bytes that went in; slow and plain.
class Oracle {
 public:
  Oracle(const Protocol& protocol, bool datagrams)
      : protocol_(protocol), datagrams_(datagrams), reader_(protocol.set) {}

  void feed(std::span<const std::byte> bytes) {
    if (datagrams_) {
      if (is_packet(bytes)) expect(bytes);
      return;
    }
    held_.insert(held_.end(), bytes.begin(), bytes.end());
    std::size_t at = 0;
    while (const std::size_t step = step_at(std::span(held_).subspan(at))) at += step;
    held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(at));
  }

  std::deque<Expected> expected;
  std::size_t packets = 0;

 private:
  bool is_packet(std::span<const std::byte> bytes) {
    const bool good = reader_.read(bytes) == PacketError::none;
    if (good) REQUIRE(protocol_.is_sealed(bytes));
    return good;
  }

  void expect(std::span<const std::byte> bytes) {
    const MessageSet& set = protocol_.set;
    const ByteOrder order = *order_of(set, bytes.data());
    const auto payload = bytes.subspan(set.header_size(), bytes.size() - set.header_size() - set.footer_size());
    expected.push_back({read_header(set, bytes.data(), order).id, order, Bytes(payload.begin(), payload.end())});
    ++packets;
  }

  // How far it is to go on behind the begin of these bytes; 0: more have to come.
  std::size_t step_at(std::span<const std::byte> bytes) {
    const MessageSet& set = protocol_.set;
    if (bytes.size() < set.sync_size()) return 0;
    const auto order = order_of(set, bytes.data());
    if (!order) return 1;
    if (bytes.size() < set.header_size()) return 0;
    const Announced announced = read_header(set, bytes.data(), *order);
    const MessageDescriptor* descriptor = set.find(announced.id, announced.payload);
    const std::size_t size = set.header_size() + announced.payload + set.footer_size();
    if (announced.payload > set.max_payload || descriptor == nullptr ||
        (descriptor->wire_size >= 0 && descriptor->wire_size != static_cast<std::int64_t>(announced.payload)))
      return 1;
    if (bytes.size() < size) return 0;
    if (!protocol_.is_sealed(bytes.first(size))) return 1;
    if (is_packet(bytes.first(size))) expect(bytes.first(size));
    return size;
  }

  const Protocol& protocol_;
  bool datagrams_;
  PacketReader reader_;
  Bytes held_;
};

// Compares each message with what is expected next; what lies between is held against what the link says of stamps that
// can't be, for a damaged packet whose checksum is right by chance can have any.
struct Compared : Receiver {
  explicit Compared(Oracle& with) : oracle(with) {}
  void receive(MessageRef message) override {
    for (;; oracle.expected.pop_front(), ++left_out) {
      REQUIRE(!oracle.expected.empty());
      const Expected& next = oracle.expected.front();
      Bytes payload;
      REQUIRE(write_payload(message, next.order, payload));
      if (message.descriptor->id == next.id && payload == next.payload) break;
    }
    oracle.expected.pop_front();
  }
  Oracle& oracle;
  std::uint64_t left_out = 0;
};

std::uint64_t stamps_refused(const Link& link) {
  return count_of(link, "dropped: stamp is no time") + count_of(link, "dropped: stamp in the future") +
         count_of(link, "dropped: stamp in the past");
}

template <class Done>
void await(const Done& done) {
  for (const auto end = std::chrono::steady_clock::now() + 20s; !done(); std::this_thread::sleep_for(20us))
    REQUIRE(std::chrono::steady_clock::now() < end);
}

void throw_at(const std::string& kind, const Protocol& protocol) {
  const auto raw = make_raw_end(kind, protocol.set, {.input = {PortKind::plain, 4096}, .output = {}, .header = {}});
  Link& link = *raw->link;
  Oracle oracle(protocol, raw->datagrams);
  Compared compared(oracle);
  const std::vector<Bytes> packets = protocol.packets();
  Random random(4);
  constexpr std::size_t together = 48;  // so few that no datagram is lost
  std::size_t thrown = 0;
  const auto all_came = [&] {
    const bool counted = raw->datagrams ? looked_at(link) == thrown : count_of(link, "packets in") == oracle.packets;
    link.receive(compared);
    return counted && compared.left_out + oracle.expected.size() == stamps_refused(link);
  };
  for (const std::size_t count = packet_count(); thrown < count;) {  // both sorts, on one of two sets
    Bytes stream;
    for (const std::size_t end = std::min(count, thrown + together); thrown < end; ++thrown) {
      Bytes bytes = thrown % 2 == 0 ? random_bytes(packets, random) : packets[below(random, packets.size())];
      if (thrown % 2 != 0) damage(bytes, random);
      oracle.feed(bytes);
      if (raw->datagrams)
        raw->write(bytes);
      else
        stream.insert(stream.end(), bytes.begin(), bytes.end());
    }
    if (!raw->datagrams) raw->write(stream);
    await(all_came);
    compared.left_out += oracle.expected.size();
    oracle.expected.clear();
  }
  await([&] { return flawed(link) > oracle.packets; });
  CHECK(oracle.packets > 0);  // some damage changes nothing
  CHECK(compared.left_out == stamps_refused(link));
  CHECK(compared.left_out < oracle.packets);
  CHECK(count_of(link, "packets in") == oracle.packets);
  CHECK(count_of(link, "dropped: input port full") == 0);
  const std::uint64_t min = flawed(link);
  CHECK(min > 0);
  CHECK(link.report().dropped >= min);
  MESSAGE(kind << ", " << std::string(protocol.set.name) << ": " << thrown << " thrown, " << oracle.packets
               << " with the right checksum, " << compared.left_out << " of these with a stamp that can't be, "
               << flawed(link) << " dropped");
}

void throw_at(const std::string& kind) {
  for (const Protocol& protocol : protocols()) throw_at(kind, protocol);
}
}  // namespace

TEST_SUITE("distributers/links/garbage") {
  TEST_CASE("of random and damaged packets those with the right checksum are received, and no others: UDP") {
    throw_at("udp");
  }
  TEST_CASE("of random and damaged packets those with the right checksum are received, and no others: TCP client") {
    throw_at("tcp_client");
  }
  TEST_CASE("of random and damaged packets those with the right checksum are received, and no others: TCP server") {
    throw_at("tcp_server");
  }
  TEST_CASE("of random and damaged packets those with the right checksum are received, and no others: serial line") {
    throw_at("serial");
  }
}
