// Values as CDR with the schema of their type, and back from either.
#include "runtime/record/cdr.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <new>

#include "graph/values/type_of.h"
#include "runtime/record/message_layout.h"
#include "runtime/record/ros2msg.h"
#include "tests/runtime/record/every_kind.h"

namespace {
using namespace jarol;
using tests::EveryKind;

std::string bytes_of(const Type& type, const void* value) {
  const CdrEncoder encoder(type);
  std::string bytes(encoder.size(value), '\xee');
  encoder.encode(value, reinterpret_cast<std::byte*>(bytes.data()));
  return bytes;
}

std::string decode(const Type& type, const std::string& bytes, void* value) {
  return decode_cdr(type, {reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()}, value);
}

}  // namespace

TEST_SUITE("runtime/cdr") {
  TEST_CASE("numbers stand at multiples of their size after four bytes of head, sequences after their length") {
    struct Small {
      bool on = true;
      double x = 1.0;
      std::int16_t n = -2;
      String text{"ab"};
      static constexpr auto fields() {
        return describe(field<&Small::on>(), field<&Small::x>("m", "how far"), field<&Small::n>(),
                        field<&Small::text>());
      }
    };
    const Small small;
    CHECK(bytes_of(type_of<Small>(), &small) == std::string("\0\1\0\0"
                                                            "\1\0\0\0\0\0\0\0"
                                                            "\0\0\0\0\0\0\xf0\x3f"
                                                            "\xfe\xff\0\0"
                                                            "\2\0\0\0ab",
                                                            4 + 8 + 8 + 4 + 6));
    CHECK(schema_of(type_of<Small>()).name == "jarol/msg/Small");
    CHECK(schema_of(type_of<Small>()).text == "bool on\nfloat64 x # [m] how far\nint16 n\nuint8[] text\n");
    const double plain = 2.5;
    CHECK(schema_of(type_of<double>()).text == "# the value itself\nfloat64 value\n");
    CHECK(bytes_of(type_of<double>(), &plain).size() == 12);
  }

  TEST_CASE("so do those of a value without sequences, whose places are the same for all values") {
    struct Flat {
      bool on = true;
      double x = 1.0;
      std::int16_t n = -2;
      std::array<std::uint8_t, 3> few{1, 2, 3};
      float last = 0.5F;
      static constexpr auto fields() {
        return describe(field<&Flat::on>(), field<&Flat::x>(), field<&Flat::n>(), field<&Flat::few>(),
                        field<&Flat::last>());
      }
    };
    const Flat flat;
    const std::string bytes = bytes_of(type_of<Flat>(), &flat);
    CHECK(bytes == std::string("\0\1\0\0"
                               "\1\0\0\0\0\0\0\0"
                               "\0\0\0\0\0\0\xf0\x3f"
                               "\xfe\xff\1\2\3\0\0\0"
                               "\0\0\0\x3f",
                               4 + 8 + 8 + 8 + 4));
    Flat back{false, 0, 0, {}, 0};
    CHECK(decode(type_of<Flat>(), bytes, &back) == "");
    CHECK(bytes_of(type_of<Flat>(), &back) == bytes);
  }

  TEST_CASE("a struct without members is a byte of zero, whatever stands there in memory") {
    struct Nothing {
      static constexpr auto fields() { return describe(); }
    };
    struct Reading {
      double x = 1.0;
      Nothing none{};
      static constexpr auto fields() { return describe(field<&Reading::x>(), field<&Reading::none>()); }
    };
    alignas(Reading) std::array<std::byte, sizeof(Reading)> memory;
    memory.fill(std::byte{0xff});
    Reading* const reading = new (memory.data()) Reading;
    memory[sizeof(double)] = std::byte{0xff};
    CHECK(bytes_of(type_of<Reading>(), reading) == std::string("\0\1\0\0\0\0\0\0\0\0\xf0\x3f\0", 4 + 8 + 1));
  }

  TEST_CASE("values of every kind come back to the bit") {
    const Type& type = type_of<EveryKind>();
    const EveryKind nothing;
    const std::uint64_t empty = type.hash_words(&nothing);
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      const EveryKind value = tests::random_every_kind(seed);
      const std::string bytes = bytes_of(type, &value);
      EveryKind back;
      REQUIRE(decode(type, bytes, &back) == "");
      REQUIRE(type.hash_words(&back) == type.hash_words(&value));  // of every word of it
      REQUIRE(bytes_of(type, &back) == bytes);
      // what is cut off anywhere is refused, and nothing is written
      for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 16) {
        EveryKind untouched;
        REQUIRE(decode(type, bytes.substr(0, size), &untouched) != "");
        REQUIRE(type.hash_words(&untouched) == empty);
      }
      REQUIRE(decode(type, bytes + "x", &back) == "ends 1 bytes before they do");
    }
  }

  TEST_CASE("a schema says where the numbers of a message stand") {
    ReadTopic topic;
    topic.channel.topic = "t";
    topic.schema = schema_of(type_of<EveryKind>()).text;
    const MessageLayout layout(topic);
    const std::vector<Leaf> leaves = leaves_of(type_of<EveryKind>());
    REQUIRE(layout.columns().size() == leaves.size());
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const EveryKind value = tests::random_every_kind(seed);
      const std::vector<MessageCell> cells = layout.read(bytes_of(type_of<EveryKind>(), &value));
      REQUIRE(cells.size() == leaves.size());
      for (std::size_t i = 0; i < leaves.size(); ++i) {
        CAPTURE(leaves[i].path);
        REQUIRE(layout.columns()[i].path == leaves[i].path);
        if (leaves[i].type->is_deep()) continue;
        std::uint64_t bits = 0;
        std::memcpy(&bits, reinterpret_cast<const std::byte*>(&value) + leaves[i].offset, leaves[i].type->size);
        REQUIRE(cells[i].bits == bits);
      }
    }
  }

  TEST_CASE("a schema that no run writes is refused") {
    const auto wrong = [](const std::string& schema) {
      ReadTopic topic;
      topic.channel.topic = "t";
      topic.schema = schema;
      try {
        MessageLayout{topic};
      } catch (const LogError& error) { return std::string(error.what()); }
      return std::string();
    };
    CHECK(wrong("float64 x\n") == "");
    CHECK(wrong("jarol/A a\n") == "the schema of 't' can't be read: it lacks the definition of 'jarol/A'");
    CHECK(wrong("jarol/A a\n=====\nMSG: jarol/A\njarol/A[] a\n") ==
          "the schema of 't' can't be read: its definitions are nested too deep");
    CHECK(wrong("float64[99999999] x\n") == "the schema of 't' can't be read: it has an array of 99999999");
  }
}
