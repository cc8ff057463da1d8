// All messages of IMC 5.4.31, their ids and fields, pinned: whoever changes one changes the numbers here.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "distributers/messages/imc.h"

using namespace jarol::messages;

namespace {
// FNV-1a
std::uint64_t digest_of(std::string_view text) {
  std::uint64_t digest = 0xcbf29ce484222325;
  for (const char c : text) digest = (digest ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return digest;
}
}  // namespace

TEST_SUITE("distributers/messages/imc_messages") {
  TEST_CASE("IMC has 349 messages with 1,552 fields, each of the id, the names, types, units and values that it had") {
    std::string all;  // id and name; then by field type, name and unit, and what its numbers mean
    std::size_t fields = 0;
    for (const MessageDescriptor* message : imc::message_set().messages) {
      all += std::to_string(message->id) + " " + std::string(message->name) + "\n";
      for (const FieldDescriptor& field : message->fields) {
        ++fields;
        all += std::string(field.type) + " " + std::string(field.name) + " " + std::string(field.unit) + "\n";
        for (const NamedValue& value : field.values)
          all += std::string(value.name) + " " + std::to_string(value.value) + "\n";
        CHECK(field.count == 0);
      }
    }
    CHECK(imc::message_set().version == "5.4.31");
    CHECK(imc::message_set().messages.size() == 349);
    CHECK(fields == 1552);
    CAPTURE(all);
    CHECK(digest_of(all) == 4150831580053701971U);
  }
}
