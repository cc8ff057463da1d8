// What a packet's header says: the link's own fields, and what a message brings along.
#include <doctest/doctest.h>

#include "distributers/links/link.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/packet.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
namespace imc = messages::imc;
}  // namespace

TEST_SUITE("distributers/header") {
  TEST_CASE(
      "a message's header adds entity and destination to its own packet, and to no other; the sender is the link's") {
    Link link(std::make_unique<UdpTransport>(Address::parse("0"), Address::parse("127.0.0.1:9")), imc::message_set(),
              {.header = {{"src", 0x00D1}}});
    messages::PacketReader reader(imc::message_set());
    const auto header_of = [&](messages::MessageRef message) {
      REQUIRE(reader.read(link.encode(message)) == messages::PacketError::none);
      return *static_cast<const imc::Header*>(reader.header().value);
    };
    const imc::Heartbeat heartbeat;
    const imc::Header addressed{.src_ent = 4, .dst = 0x4001, .dst_ent = 9};
    messages::MessageRef message = messages::refer_to(heartbeat);
    message.header = &addressed;
    const imc::Header with = header_of(message), without = header_of(messages::refer_to(heartbeat));
    CHECK(with.src == 0x00D1);
    CHECK(with.src_ent == 4);
    CHECK(with.dst == 0x4001);
    CHECK(with.dst_ent == 9);
    CHECK(with.mgid == imc::Heartbeat::message_id);
    CHECK(with.timestamp > 1e9);
    CHECK(without.src == 0x00D1);
    CHECK(without.src_ent == 255);
    CHECK(without.dst == 0xffff);
    CHECK(without.dst_ent == 255);
  }
}
