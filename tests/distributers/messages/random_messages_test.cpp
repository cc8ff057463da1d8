// Every message of the project's sets with random values, to bytes, to JSON and back.
#include <doctest/doctest.h>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "tests/distributers/messages/random_message.h"

using namespace jarol::messages;

TEST_SUITE("distributers/messages/random_messages") {
  TEST_CASE("every message comes back as it was, in both byte orders and as JSON") {
    std::mt19937_64 random(4);
    CHECK(round_trip(imc::message_set(), random, 20) == "");
    CHECK(round_trip(javiator::message_set(), random, 100) == "");
  }
}
