// Random and damaged packets: none crashes, none is taken unless its checksum holds.
#include <doctest/doctest.h>

#include <cstdlib>
#include <random>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "distributers/messages/packet.h"
#include "distributers/messages/stream_reader.h"
#include "tests/distributers/messages/recorded.h"

using namespace jarol;
using namespace jarol::messages;

namespace {

using Bytes = std::vector<std::byte>;
using Random = std::mt19937_64;

int packet_count() { return std::getenv("JAROL_FULL") != nullptr ? 1'000'000 : 50'000; }

// bit by bit, unlike the codec's table
std::uint16_t crc_of(std::span<const std::byte> bytes) {
  std::uint16_t crc = 0;
  for (const std::byte b : bytes)
    for (int bit = 0; bit < 8; ++bit) {
      const bool carry = (((crc ^ (std::to_integer<unsigned>(b) >> bit)) & 1U) != 0);
      crc = static_cast<std::uint16_t>((crc >> 1) ^ (carry ? 0xa001U : 0U));
    }
  return crc;
}

struct Protocol {
  const MessageSet& set;
  const char* recorded;
  bool is_imc;

  // The checksum that the bytes should end with, as two bytes on the wire.
  std::array<std::byte, 2> seal(std::span<const std::byte> bytes) const {
    const auto before = bytes.first(bytes.size() - 2);
    if (is_imc) {
      const std::uint16_t crc = crc_of(before);
      const std::byte low{static_cast<unsigned char>(crc & 0xff)}, high{static_cast<unsigned char>(crc >> 8)};
      if (bytes[0] == std::byte{0x54}) return {low, high};
      return {high, low};
    }
    unsigned sum = 0;
    for (const std::byte b : before.subspan(2)) sum += std::to_integer<unsigned>(b);
    return {std::byte{static_cast<unsigned char>(sum >> 8)}, std::byte{static_cast<unsigned char>(sum)}};
  }

  bool is_sealed(std::span<const std::byte> bytes) const {
    return bytes.size() > 2 && std::ranges::equal(seal(bytes), bytes.last(2));
  }
};

const std::array<Protocol, 2> protocols{Protocol{imc::message_set(), "imc-packets.jsonl", true},
                                        Protocol{javiator::message_set(), "javiator-packets.jsonl", false}};

std::size_t below(Random& random, std::size_t limit) { return random() % limit; }

// Bytes changed, put in, left out or cut off.
void damage(Bytes& packet, Random& random) {
  for (std::size_t times = 1 + below(random, 4); times > 0; --times) {
    const std::size_t at = below(random, packet.size() + 1);
    const auto value = static_cast<std::byte>(random());
    switch (below(random, 4)) {
      case 0: packet.insert(packet.begin() + static_cast<std::ptrdiff_t>(at), value); break;
      case 1:
        if (at < packet.size()) packet.erase(packet.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 2: packet.resize(at); break;
      default:
        if (at < packet.size()) packet[at] = value;
    }
  }
}

// Damages the payload and makes size and checksum right again, so that the fields are looked at.
void damage_fields(const Protocol& protocol, Bytes& packet, Random& random) {
  const std::size_t header = protocol.set.header_size();
  Bytes payload(packet.begin() + static_cast<std::ptrdiff_t>(header), packet.end() - 2);
  damage(payload, random);
  if (!protocol.is_imc) payload.resize(std::min<std::size_t>(payload.size(), 122));
  packet.resize(header);
  packet.insert(packet.end(), payload.begin(), payload.end());
  packet.resize(packet.size() + 2);
  if (protocol.is_imc) {
    packet[4] = static_cast<std::byte>(payload.size());
    packet[5] = static_cast<std::byte>(payload.size() >> 8);
  } else {
    packet[3] = static_cast<std::byte>(payload.size());
  }
  const auto seal = protocol.seal(packet);
  std::copy(seal.begin(), seal.end(), packet.end() - 2);
}

std::vector<Bytes> packets_of(const Protocol& protocol) {
  std::vector<Bytes> packets;
  for (const nlohmann::json& packet : recorded(protocol.recorded)) packets.push_back(bytes_of(packet["hex"]));
  return packets;
}

}  // namespace

TEST_SUITE("distributers/messages/mutations") {
  TEST_CASE("of random bytes and damaged packets those with the right checksum are taken, and no others") {
    for (const Protocol& protocol : protocols) {
      Random random(1);
      PacketReader reader(protocol.set);
      const std::vector<Bytes> packets = packets_of(protocol);
      std::size_t taken = 0, refused = 0;
      for (int i = 0; i < packet_count(); ++i) {
        Bytes bytes;
        if (i % 2 == 0) {
          bytes.resize(below(random, 130));
          for (std::byte& b : bytes) b = static_cast<std::byte>(random());
          // half of them begin like a packet
          const Bytes& like = packets[below(random, packets.size())];
          if (i % 4 == 0)
            std::copy_n(like.begin(), std::min(like.size(), std::min<std::size_t>(bytes.size(), 6)), bytes.begin());
        } else {
          bytes = packets[below(random, packets.size())];
          damage(bytes, random);
        }
        const Flaw flaw = reader.read(bytes);
        if (flaw == Flaw::none) REQUIRE(protocol.is_sealed(bytes));
        ++(flaw == Flaw::none ? taken : refused);
      }
      MESSAGE(taken << " taken, " << refused << " refused");
      CHECK(taken > 0);  // some damage changes nothing
      CHECK(refused > taken);
    }
  }

  TEST_CASE("a packet with damaged fields under a right checksum is refused, or written back byte for byte") {
    for (const Protocol& protocol : protocols) {
      Random random(2);
      PacketReader reader(protocol.set);
      const std::vector<Bytes> packets = packets_of(protocol);
      std::size_t taken = 0, refused = 0;
      Bytes written;
      for (int i = 0; i < packet_count(); ++i) {
        Bytes bytes = packets[below(random, packets.size())];
        damage_fields(protocol, bytes, random);
        const Flaw flaw = reader.read(bytes);
        REQUIRE((flaw == Flaw::none || flaw == Flaw::payload));
        ++(flaw == Flaw::none ? taken : refused);
        if (flaw != Flaw::none) continue;
        REQUIRE(write_packet(reader.header(), reader.message(), reader.order(), written));
        REQUIRE(written == bytes);
      }
      MESSAGE(taken << " taken, " << refused << " refused");
      CHECK(taken > 0);
      CHECK(refused > 0);
    }
  }

  TEST_CASE("in a stream of damaged packets the undamaged ones are found") {
    for (const Protocol& protocol : protocols) {
      Random random(3);
      StreamReader reader(protocol.set, 1024);
      const std::vector<Bytes> packets = packets_of(protocol);
      Bytes stream;
      std::size_t good = 0;
      for (int i = 0; i < packet_count() / 10; ++i) {
        Bytes bytes = packets[below(random, packets.size())];
        const bool whole = random() % 2 == 0;
        if (!whole) damage(bytes, random);
        good += whole ? 1 : 0;
        stream.insert(stream.end(), bytes.begin(), bytes.end());
      }
      std::size_t fed = 0;
      while (fed < stream.size()) {
        const auto room = reader.room();
        const std::size_t size = std::min({room.size(), stream.size() - fed, 1 + below(random, 300)});
        std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(fed), size, room.begin());
        reader.filled(size);
        fed += size;
        while (reader.next()) {}
      }
      reader.give_up();
      while (reader.next()) {}
      const PacketCounts& counts = reader.counts();
      CHECK(counts.bytes + counts.dropped_bytes == stream.size());
      CHECK(counts.packets >= good);
      MESSAGE(good << " undamaged, " << counts.packets << " taken");
    }
  }
}
