// What crosses from a link's receiving thread to the run's: the message that was sent, of any form, with its header.
#include "distributers/links/entries.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>

#include "distributers/messages/message_set.h"
#include "distributers/messages/packet.h"
#include "tests/distributers/messages/random_message.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
}  // namespace

TEST_SUITE("distributers/links/entries") {
  TEST_CASE("a message of every form, in both byte orders, is read as it was written, with its header and its peer") {
    for (const messages::MessageSet* set : messages::message_sets()) {
      CAPTURE(set->name);
      std::mt19937_64 random(5);
      messages::PacketReader packet(*set);
      EntryWriter writer(*set);
      EntryReader reader(*set);
      CHECK(reader.peer() == 0);
      std::vector<std::byte> sent, again;
      std::size_t longest = 0;
      std::uint32_t peer = 0;
      for (int round = 0; round < 20; ++round)
        for (const messages::MessageDescriptor* form : set->messages) {
          const bool turned = set->either_order && round % 2 == 1;
          const auto order = turned ? messages::ByteOrder::big : set->order;
          if (!messages::write_packet(messages::random_message(*set->header, random),
                                      messages::random_message(*form, random), order, sent))
            continue;
          REQUIRE(packet.check(sent) == messages::PacketError::none);
          const auto entry = writer.write(packet, ++peer);
          const std::vector<std::byte> expected = std::exchange(sent, {});  // the next may come before it is read
          std::fill(reader.room().begin(), reader.room().end(), std::byte{0xdd});
          std::copy(entry.begin(), entry.end(), reader.room().begin());
          longest = std::max(longest, entry.size());
          const messages::MessageRef message = reader.read();
          REQUIRE(reader.peer() == peer);
          REQUIRE(message.descriptor == packet.descriptor());
          REQUIRE(messages::write_packet({set->header, message.header}, message, order, again));
          REQUIRE(again == expected);
        }
      CHECK(longest <= longest_entry(*set));
    }
  }
}
