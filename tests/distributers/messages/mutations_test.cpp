// Random and damaged packets: none crashes, none is taken unless its checksum holds.
#include <doctest/doctest.h>

#include <algorithm>

#include "distributers/messages/packet.h"
#include "distributers/messages/payload.h"
#include "distributers/messages/stream_reader.h"
#include "tests/distributers/messages/damage.h"
#include "tests/how_many.h"

using namespace jarol;
using namespace jarol::messages;
using namespace jarol::tests;

namespace {

int packet_count() { return jarol::tests::how_many(50'000, 1'000'000); }

}  // namespace

TEST_SUITE("distributers/messages/mutations") {
  TEST_CASE("of random bytes and damaged packets those with the right checksum are taken, and no others") {
    for (const Protocol& protocol : protocols()) {
      Random random(1);
      PacketReader reader(protocol.set);
      const std::vector<Bytes> packets = protocol.packets();
      std::size_t taken = 0, refused = 0;
      for (int i = 0; i < packet_count(); ++i) {
        Bytes bytes = i % 2 == 0 ? random_bytes(packets, random) : packets[below(random, packets.size())];
        if (i % 2 != 0) damage(bytes, random);
        const PacketError packet_error = reader.read(bytes);
        if (packet_error == PacketError::none) REQUIRE(protocol.is_sealed(bytes));
        ++(packet_error == PacketError::none ? taken : refused);
      }
      MESSAGE(taken << " taken, " << refused << " refused");
      CHECK(taken > 0);  // some damage changes nothing
      CHECK(refused > taken);
    }
  }

  TEST_CASE("a packet with damaged fields under a right checksum is refused, or written back byte for byte") {
    for (const Protocol& protocol : protocols()) {
      Random random(2);
      PacketReader reader(protocol.set);
      const std::vector<Bytes> packets = protocol.packets();
      std::size_t taken = 0, refused = 0;
      Bytes written;
      for (int i = 0; i < packet_count(); ++i) {
        Bytes bytes = packets[below(random, packets.size())];
        damage_fields(protocol, bytes, random);
        const PacketError packet_error = reader.read(bytes);
        REQUIRE((packet_error == PacketError::none || packet_error == PacketError::payload));
        ++(packet_error == PacketError::none ? taken : refused);
        if (packet_error != PacketError::none) continue;
        REQUIRE(write_packet(reader.header(), reader.message(), reader.order(), written));
        REQUIRE(written == bytes);
      }
      MESSAGE(taken << " taken, " << refused << " refused");
      CHECK(taken > 0);
      CHECK(refused > 0);
    }
  }

  TEST_CASE("what is checked alone gets the same answer, in the same words, as what is read") {
    for (const Protocol& protocol : protocols()) {
      Random random(3);
      PacketReader checker(protocol.set);
      const std::vector<Bytes> packets = protocol.packets();
      for (int i = 0; i < packet_count() / 10; ++i) {
        Bytes bytes = packets[below(random, packets.size())];
        damage_fields(protocol, bytes, random);
        std::string of_check, of_payload;
        const bool good = checker.check(bytes, &of_check) == PacketError::none;
        // the message as it would be taken out, by its own rules
        const Announced announced = read_header(protocol.set, bytes.data(), *order_of(protocol.set, bytes.data()));
        const auto payload = std::span<const std::byte>(bytes).subspan(protocol.set.header_size(), announced.payload);
        const MessageDescriptor* const form = protocol.set.find(announced.id, announced.payload);
        REQUIRE(form != nullptr);
        Message message(*form);
        REQUIRE(read_payload(*form, *order_of(protocol.set, bytes.data()), payload, message.value(), &of_payload) ==
                good);
        REQUIRE(of_payload == of_check);
      }
    }
  }

  TEST_CASE("in a stream of damaged packets the undamaged ones are found") {
    for (const Protocol& protocol : protocols()) {
      Random random(3);
      StreamReader reader(protocol.set, 1024);
      const std::vector<Bytes> packets = protocol.packets();
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
