// Packets of real peers, and packets that are wrong in every way.
#include "distributers/messages/packet.h"

#include <doctest/doctest.h>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "tests/distributers/messages/recorded.h"

using namespace jarol;
using namespace jarol::messages;

namespace {

// What is wrong with the bytes, in words.
std::string complaint(const MessageSet& set, const std::vector<std::byte>& bytes) {
  std::string why;
  const PacketError packet_error = PacketReader(set).read(bytes, &why);
  return std::string(name_of(packet_error)) + ": " + why;
}

}  // namespace

TEST_SUITE("distributers/messages/packet") {
  TEST_CASE("recorded packets are read and written back byte for byte") {
    for (const auto& [set, file, count] : {std::tuple{&imc::message_set(), "imc-packets.jsonl", 98},
                                           std::tuple{&javiator::message_set(), "javiator-packets.jsonl", 214}}) {
      PacketReader reader(*set);
      int same = 0;
      for (const nlohmann::json& packet : recorded(file)) {
        const std::string hex = packet["hex"];
        std::string why;
        reader.read(bytes_of(hex), &why);
        CHECK_MESSAGE(why == "", packet.dump());
        if (reader.message().descriptor == nullptr) continue;
        CHECK(reader.message().descriptor->name == packet["name"]);
        std::vector<std::byte> written;
        CHECK(write_packet(reader.header(), reader.message(), reader.order(), written));
        CHECK(hex_of(written) == hex);
        same += hex_of(written) == hex ? 1 : 0;
      }
      CHECK(same == count);
    }
  }

  TEST_CASE("packets are byte for byte those of the original programs") {
    const auto written = [](MessageRef header, MessageRef message, ByteOrder order) {
      std::vector<std::byte> bytes;
      REQUIRE(write_packet(header, message, order, bytes));
      return hex_of(bytes);
    };
    const auto javiator_packet = [&](MessageRef message) {
      return written(refer_to(javiator::Header{}), message, ByteOrder::big);
    };
    CHECK(javiator_packet(refer_to(javiator::SwitchState{})) == "ffff11000011");
    CHECK(javiator_packet(refer_to(javiator::IdleLimit{8000})) == "ffff0f021f400070");
    CHECK(javiator_packet(refer_to(javiator::CommandData{})) == "ffff0a0800000000000000000012");
    CHECK(javiator_packet(refer_to(javiator::RollPitchParams{1700, 0, 500, -70})) == "ffff0b0806a4000001f4ffba036b");
    CHECK(javiator_packet(refer_to(javiator::ShutDown{})) == "ffff15000015");

    // the header's defaults are those of a packet from nobody to anybody
    CHECK(written(refer_to(imc::Header{}), refer_to(imc::Heartbeat{}), ByteOrder::little).substr(0, 40) ==
          "54fe960000000000000000000000ffffffffffff");
    CHECK(written(refer_to(imc::Header{}), refer_to(imc::DesiredZ{1.5F, 1}), ByteOrder::big).substr(0, 50) ==
          "fe54019100050000000000000000ffffffffffff3fc0000001");
  }

  TEST_CASE("a packet in the other byte order holds the same message") {
    PacketReader little(imc::message_set()), big(imc::message_set());
    for (const nlohmann::json& packet : recorded("imc-packets.jsonl")) {
      REQUIRE(little.read(bytes_of(packet["hex"])) == PacketError::none);
      std::vector<std::byte> turned, back;
      REQUIRE(write_packet(little.header(), little.message(), ByteOrder::big, turned));
      std::string why;
      big.read(turned, &why);
      CHECK(why == "");
      CHECK(big.order() == ByteOrder::big);
      REQUIRE(write_packet(big.header(), big.message(), ByteOrder::little, back));
      CHECK(hex_of(back) == packet["hex"]);
    }
  }

  TEST_CASE("what is wrong with a packet is said") {
    const MessageSet& imc_set = imc::message_set();
    const std::string heartbeat = "54fe96000000d9f6b28c38c0da41d10000ffffff7b33";
    CHECK(complaint(imc_set, bytes_of(heartbeat)) == "none: ");
    CHECK(complaint(imc_set, {}) == "truncated: the packet has 0 bytes; header and checksum alone take 22");
    CHECK(complaint(imc_set, bytes_of("53" + heartbeat.substr(2))) ==
          "garbage: the packet begins with 0xfe53, not with 0xfe54");
    CHECK(complaint(imc_set, bytes_of(heartbeat + "00")) ==
          "oversized: the packet has 23 bytes; by its header it has 22");
    CHECK(complaint(imc_set, bytes_of("54fe96000100" + heartbeat.substr(12))) ==
          "truncated: the packet has 22 bytes; by its header it has 23");
    CHECK(complaint(imc_set, bytes_of(heartbeat.substr(0, 40) + "7b34")) ==
          "bad checksum: the checksum is 0x347b; 0x337b would be right");
    CHECK(complaint(imc_set, bytes_of("54fe9600ffff" + heartbeat.substr(12))) ==
          "oversized: the header states 65535 bytes of payload; at most 65513 are allowed");

    const MessageSet& javiator_set = javiator::message_set();
    CHECK(complaint(javiator_set, bytes_of("ffff17000017")) == "unknown id: message id 23 is not in set javiator");
    CHECK(complaint(javiator_set, bytes_of("ffff0f011f002f")) ==
          "bad payload: field 'idle' of IDLE_LIMIT needs 2 bytes where 1 are left");
    CHECK(complaint(javiator_set, bytes_of("ffff11010214")) ==
          "truncated: the packet has 6 bytes; by its header it has 7");
    CHECK(complaint(javiator_set, bytes_of("ffff1101020014")) ==
          "bad payload: SWITCH_STATE has 0 bytes of fields, but 1 of payload");
  }
}
