// Schemas that somebody has made: none makes much of little.
#include "runtime/record/message_layout.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol;

const std::string next_definition = std::string(80, '=') + "\nMSG: jarol/";

// A message with that many elements and as many bytes.
std::string sequence_of(std::uint32_t count) {
  std::string bytes{'\0', '\1', '\0', '\0'};
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  return bytes + std::string(count, '\0');
}
}  // namespace

TEST_SUITE("runtime/message_layout") {
  TEST_CASE("a definition without fields is none that Jarol writes") {
    for (const std::string& fields : {std::string(), std::string("# nothing\n"), std::string("int32 ONE=1\n")}) {
      CHECK_THROWS_WITH_AS(MessageLayout("x", "jarol/A[1048576] a\n" + next_definition + "A\njarol/B[1048576] b\n" +
                                                  next_definition + "B\n" + fields),
                           "the schema of 'x' can't be read: one of its definitions has no fields", LogError);
      CHECK_THROWS_WITH_AS(MessageLayout("x", fields),
                           "the schema of 'x' can't be read: one of its definitions has no fields", LogError);
    }
    CHECK_THROWS_WITH_AS(MessageLayout("x", "float64[0] a\n"), "the schema of 'x' can't be read: it has an array of 0",
                         LogError);
  }

  TEST_CASE("arrays of arrays that make millions of columns, or of bytes of their names, are refused") {
    const std::string many = "jarol/A[1024] a\n" + next_definition + "A\njarol/B[1024] b\n" + next_definition + "B\n";
    CHECK_THROWS_WITH_AS(MessageLayout("x", many + "float64[1024] c\n"),
                         "the schema of 'x' can't be read: it has more than 1048576 fields", LogError);
    CHECK_THROWS_WITH_AS(MessageLayout("x", "float64[100000] " + std::string(1000, 'a') + "\n"),
                         "the schema of 'x' can't be read: the names of its fields are longer than 67108864 bytes",
                         LogError);
    CHECK(MessageLayout("x", "float64[100000] a\n").columns().size() == 100'000);
  }

  TEST_CASE("a sequence of structs has as much text as its bytes allow") {
    const MessageLayout layout("x", "jarol/A[] a\n" + next_definition + "A\nuint8[2] b\nbool c\n");
    std::string two = sequence_of(2) + std::string(4, '\0');
    CHECK(layout.read(two).at(0).text == "[{[0 0] [0]} {[0 0] [0]}]");
    CHECK_THROWS_WITH_AS(layout.read(sequence_of(2)), "a message ends before its fields do", LogError);
  }
}
