// Packets that a guardian sends later, without their message set.
#include "distributers/guardian/stamped_packet.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "distributers/links/timestamp.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "distributers/messages/packet.h"

namespace {
using namespace jarol;
using distributers::Stamping;
using messages::PacketError;
using Bytes = std::vector<std::byte>;

// A rudder's command of long ago.
Bytes packet_of_set(const messages::MessageSet& set, messages::ByteOrder order) {
  messages::Message header(*set.header), message(*set.find("SetServoPosition"));
  messages::imc::SetServoPosition& servo = *static_cast<messages::imc::SetServoPosition*>(message.value());
  servo.id = 2;
  servo.value = 0.25;
  Bytes packet;
  REQUIRE(messages::write_packet(header, message, order, packet));
  return packet;
}

double time_in(const messages::PacketReader& reader) {
  double time = 0;
  const messages::FieldDescriptor* const field = distributers::find_timestamp(messages::imc::message_set());
  std::memcpy(&time, static_cast<const std::byte*>(reader.header().value) + field->offset, sizeof time);
  return time;
}
}  // namespace

TEST_SUITE("distributers/guardian/stamped_packet") {
  TEST_CASE("a packet with a time in its header is of the moment at which it is stamped, and else the same") {
    const messages::MessageSet& set = messages::imc::message_set();
    const Bytes before = packet_of_set(set, set.order);
    Bytes packet = before;
    const double first = distributers::seconds_since_1970();
    distributers::stamp(distributers::stamping_of(set), packet);
    const double last = distributers::seconds_since_1970();
    messages::PacketReader reader(set);
    REQUIRE(reader.read(packet) == PacketError::none);
    CHECK(time_in(reader) >= first);
    CHECK(time_in(reader) <= last);
    const auto* const servo = reader.message().as<messages::imc::SetServoPosition>();
    REQUIRE(servo != nullptr);
    CHECK(servo->id == 2);
    CHECK(servo->value == 0.25F);
    // header but for the time, and payload
    const std::uint32_t at = distributers::stamping_of(set).time_at;
    REQUIRE(packet.size() == before.size());
    for (std::size_t i = 0; i + set.footer_size() < packet.size(); ++i)
      if (i < at || i >= at + 8) CHECK(packet[i] == before[i]);
  }

  TEST_CASE("so is one of a set in the other byte order, and with a sum for a checksum") {
    messages::MessageSet other = messages::imc::message_set();
    other.order = messages::ByteOrder::big;
    other.checksum = messages::Checksum::sum16;
    other.checksum_from = 3;
    const Stamping stamping = distributers::stamping_of(other);
    CHECK(stamping.checksum_from == 3);
    Bytes packet = packet_of_set(messages::imc::message_set(), other.order);
    distributers::stamp(stamping, packet);
    messages::PacketReader reader(other);
    CHECK(reader.read(packet) == PacketError::none);
    CHECK(time_in(reader) > 1.7e9);
  }

  TEST_CASE("one of a set without a time stays as it is") {
    const messages::MessageSet& set = messages::javiator::message_set();
    const Stamping stamping = distributers::stamping_of(set);
    CHECK(stamping.time_at == Stamping::none);
    const Bytes before{std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}};
    Bytes packet = before;
    distributers::stamp(stamping, packet);
    CHECK(packet == before);
  }

  TEST_CASE("bytes that are too short for what is to be stamped stay as they are") {
    const Stamping stamping = distributers::stamping_of(messages::imc::message_set());
    for (std::size_t size = 0; size < stamping.time_at + 10; ++size) {
      const Bytes before(size, std::byte{7});
      Bytes packet = before;
      distributers::stamp(stamping, packet);
      CHECK(packet == before);
    }
  }
}
