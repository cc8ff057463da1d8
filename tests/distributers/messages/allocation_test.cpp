// Reading and writing packets asks for no memory once each message has been seen.
#include <doctest/doctest.h>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "distributers/messages/stream_reader.h"
#include "tests/counted_allocations.h"
#include "tests/distributers/messages/recorded.h"

using namespace jarol;
using namespace jarol::messages;

TEST_SUITE("distributers/messages/allocation") {
  TEST_CASE(
      "the second reading of a conversation and its writing allocate nothing, garbage and broken packets included") {
    for (const auto& [set, file] : {std::pair{&imc::message_set(), "imc-packets.jsonl"},
                                    std::pair{&javiator::message_set(), "javiator-packets.jsonl"}}) {
      std::vector<std::vector<std::byte>> packets;
      for (const nlohmann::json& packet : recorded(file)) {
        packets.push_back(bytes_of(packet["hex"]));
        packets.push_back(packets.back());
        packets.back()[packets.back().size() / 2] ^= std::byte{1};
      }
      StreamReader reader(*set);
      std::vector<std::byte> written;
      written.reserve(4096);
      const auto converse = [&] {
        for (const std::vector<std::byte>& packet : packets) {
          std::copy(packet.begin(), packet.end(), reader.room().begin());
          reader.filled(packet.size());
          while (reader.next()) REQUIRE(write_packet(reader.header(), reader.message(), reader.order(), written));
        }
      };
      converse();
      const PacketCounts once = reader.counts();
      CHECK(once.packets > packets.size() / 3);
      const std::uint64_t before = tests::allocations();
      converse();
      CHECK(tests::allocations() == before);
      CHECK(reader.counts().packets > once.packets);
    }
  }
}
