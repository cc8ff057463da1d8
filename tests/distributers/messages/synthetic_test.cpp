// A set of 350 messages with every feature that a definition can have: its C++ compiles, and works.
#include "distributers/messages/synthetic.h"

#include <doctest/doctest.h>

#include "tests/distributers/messages/random_message.h"

using namespace jarol;
using namespace jarol::messages;

TEST_SUITE("distributers/messages/synthetic") {
  TEST_CASE("all 350 messages are there, by id and by name") {
    const MessageSet& set = synthetic::message_set();
    CHECK(set.messages.size() == 350);
    CHECK(set.title == "Synthetic");
    CHECK(set.find(std::string_view("Message002")) == set.find(4, 0));
    CHECK(set.find(9001, 1)->name == "SharedShort");
    CHECK(set.find(9001, 8)->name == "SharedLong");
    CHECK(set.find_nested(9001) == nullptr);
    CHECK(set.find(9000, 9) == &synthetic::VeryFlat::descriptor);
  }

  TEST_CASE("every message comes back as it was, in both byte orders and as JSON") {
    std::mt19937_64 random(5);
    CHECK(round_trip(synthetic::message_set(), random, 20) == "");
  }

  TEST_CASE("what a definition says is in its C++") {
    CHECK(synthetic::Header{}.sync == 0xabcd);
    CHECK(synthetic::Mask::ALL == 0xffffffff);
    CHECK(synthetic::Shared::class_ == 0);
    CHECK(type_of<synthetic::Message004>().fields.size() == 2);
    CHECK(synthetic::Message004::descriptor.fields.size() == 4);  // those of the parts
  }
}
