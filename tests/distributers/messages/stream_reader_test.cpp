// Packets out of streams of bytes: where they are found, and how it is counted what is not one.
#include "distributers/messages/stream_reader.h"

#include <doctest/doctest.h>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "tests/distributers/messages/recorded.h"

using namespace jarol;
using namespace jarol::messages;

namespace {

// Feeds the bytes in pieces of at most `piece`; returns the packets found, written anew.
std::vector<std::string> feed(StreamReader& reader, const std::string& hex, std::size_t piece = 1000) {
  std::vector<std::string> found;
  const std::vector<std::byte> bytes = bytes_of(hex);
  const auto take = [&] {
    std::vector<std::byte> written;
    while (reader.next()) {
      REQUIRE(write_packet(reader.header(), reader.message(), reader.order(), written));
      found.push_back(hex_of(written));
    }
  };
  for (std::size_t at = 0; at < bytes.size();) {
    const auto room = reader.room();
    const std::size_t size = std::min({room.size(), piece, bytes.size() - at});
    REQUIRE(size > 0);
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), size, room.begin());
    reader.filled(size);
    at += size;
    take();
  }
  take();
  return found;
}

std::string text_of(const PacketCounts& counts) {
  std::string text = std::to_string(counts.packets) + " taken";
  for (std::size_t i = 1; i < packet_error_count; ++i)
    if (counts.dropped[i] > 0)
      text += ", " + std::to_string(counts.dropped[i]) + " " + std::string(name_of(static_cast<PacketError>(i)));
  return text + ", " + std::to_string(counts.dropped_bytes) + " bytes dropped";
}

using Hex = std::vector<std::string>;
const std::string idle = "ffff0f021f400070", hello = "ffff11000011";

}  // namespace

TEST_SUITE("distributers/messages/stream_reader") {
  TEST_CASE("a conversation is the same however it is cut into pieces") {
    for (const auto& [set, file] : {std::pair{&imc::message_set(), "imc-packets.jsonl"},
                                    std::pair{&javiator::message_set(), "javiator-packets.jsonl"}}) {
      Hex packets;
      std::string stream;
      for (const nlohmann::json& packet : recorded(file)) {
        packets.push_back(packet["hex"]);
        stream += packets.back();
      }
      for (const std::size_t piece : {1, 2, 3, 7, 64, 100'000}) {
        StreamReader reader(*set);
        CHECK(feed(reader, stream, piece) == packets);
        CHECK(reader.counts().packets == packets.size());
        CHECK(reader.counts().bytes == stream.size() / 2);
        CHECK(reader.counts().dropped_bytes == 0);
      }
    }
  }

  TEST_CASE("what is dropped is counted by its reason") {
    StreamReader reader(javiator::message_set());
    const auto after = [&](const std::string& hex, const Hex& found) {
      CHECK(feed(reader, hex) == found);
      return text_of(reader.counts());
    };
    SUBCASE("garbage") {
      CHECK(after("0102" + idle + "03" + hello + "0000ff", {idle, hello}) == "2 taken, 3 garbage, 5 bytes dropped");
    }
    SUBCASE("a bad checksum") {
      CHECK(after(idle + "ffff0f021f400071" + "ffff0f021f400072" + hello, {idle, hello}) ==
            "2 taken, 2 bad checksum, 16 bytes dropped");
    }
    SUBCASE("an id that is not in the set") {
      CHECK(after("ffff17000017" + hello, {hello}) == "1 taken, 1 unknown id, 6 bytes dropped");
    }
    SUBCASE("a payload that is not the message's") {
      CHECK(after("ffff1101020014" + hello, {hello}) == "1 taken, 1 bad payload, 7 bytes dropped");
    }
    SUBCASE("a length that no packet has") {
      CHECK(after("ffff0fff" + hello, {hello}) == "1 taken, 1 oversized, 4 bytes dropped");
    }
    SUBCASE("a packet that was cut off") {
      CHECK(after("ffff0a08000000" + hello, {}) == "0 taken, 0 bytes dropped");  // it could still be one packet
      CHECK(after(hello, {hello, hello}) == "2 taken, 1 bad checksum, 7 bytes dropped");
    }
  }

  TEST_CASE("a packet that is cut off at the end is given up") {
    StreamReader reader(javiator::message_set());
    CHECK(feed(reader, "ffff0a080000" + hello) == Hex{});
    reader.give_up();
    CHECK(feed(reader, "") == Hex{hello});
    CHECK(text_of(reader.counts()) == "1 taken, 1 truncated, 6 bytes dropped");
    CHECK(feed(reader, idle) == Hex{idle});  // as if nothing had been
  }

  TEST_CASE("the reader's own limit is below the set's") {
    StreamReader reader(imc::message_set(), 64);
    const auto packets = recorded("imc-packets.jsonl");
    Hex small;
    std::string stream;
    for (const nlohmann::json& packet : packets) {
      const std::string hex = packet["hex"];
      stream += hex;
      if (hex.size() <= 2 * 64) small.push_back(hex);
    }
    CHECK(feed(reader, stream) == small);
    CHECK(reader.counts().dropped_for(PacketError::oversized) == packets.size() - small.size());
  }

  TEST_CASE("a sync right behind one more byte of its kind is found") {
    StreamReader reader(javiator::message_set());
    CHECK(feed(reader, "ff" + hello) == Hex{hello});
    CHECK(text_of(reader.counts()) == "1 taken, 1 unknown id, 1 bytes dropped");
  }
}
