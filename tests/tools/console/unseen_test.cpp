// What a page was sent and has not said to have seen.
#include "tools/console/unseen.h"
#include "graph/text/errors.h"

#include <doctest/doctest.h>

#include <stdexcept>

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tools::console::Unseen;
using Time = Unseen::Time;
}  // namespace

TEST_SUITE("console/unseen") {
  TEST_CASE("a page that never says what it has seen gets all, and is not behind") {
    Unseen unseen;
    for (std::size_t i = 0; i < Unseen::max_kept + 10; ++i) unseen.send(Time{1s}, Time{1s});
    const Time next{1s};
    CHECK(unseen.has_room(Time{60s}));
    CHECK(unseen.behind(Time{60s}, &next) == 0s);
    CHECK_THROWS_WITH_AS(unseen.see(Unseen::max_kept + 11),
                         "'messages' of seen is 1011, of 1010 that were sent and 0 seen", InputError);
    CHECK_NOTHROW(unseen.see(Unseen::max_kept + 10));
  }

  TEST_CASE("a page that says late how much it has seen, more than is kept, goes on from there") {
    Unseen unseen;
    for (std::size_t i = 0; i < Unseen::max_kept + 10; ++i) unseen.send(Time{1s}, Time{1s});
    for (const std::uint64_t seen : {1U, 2U, 11U}) CHECK_NOTHROW(unseen.see(seen));
    CHECK_THROWS_WITH_AS(unseen.see(10), "'messages' of seen is 10, of 1010 that were sent and 11 seen", InputError);
    unseen.see(Unseen::max_kept + 10);
    CHECK(unseen.is_all_seen());
  }

  TEST_CASE("a page has room while the oldest that it has not seen was sent a moment ago") {
    Unseen unseen;
    unseen.see(0);
    unseen.send(Time{0s}, Time{10s});
    CHECK(unseen.has_room(Time{10s} + Unseen::patience));
    CHECK_FALSE(unseen.has_room(Time{10s} + Unseen::patience + 1ns));
    unseen.send(Time{10s}, Time{10s} + 100ms);
    unseen.see(1);
    CHECK(unseen.has_room(Time{10s} + 100ms + Unseen::patience));
    CHECK_FALSE(unseen.has_room(Time{10s} + 101ms + Unseen::patience));
    unseen.see(2);
    CHECK(unseen.has_room(Time{1000s}));
  }

  TEST_CASE("it is behind by the age of the oldest that it has not seen, or was not sent yet") {
    Unseen unseen;
    unseen.see(0);
    const Time next{7s};
    CHECK(unseen.behind(Time{9s}, nullptr) == 0s);
    CHECK(unseen.behind(Time{9s}, &next) == 2s);
    unseen.send(Time{4s}, Time{8s});
    CHECK(unseen.behind(Time{9s}, &next) == 5s);
    unseen.see(1);
    CHECK(unseen.behind(Time{9s}, nullptr) == 0s);
  }

  TEST_CASE("what was seen stays seen") {
    Unseen unseen;
    for (int i = 0; i < 3; ++i) unseen.send(Time{0s}, Time{0s});
    unseen.see(2);
    CHECK_THROWS_WITH_AS(unseen.see(1), "'messages' of seen is 1, of 3 that were sent and 2 seen", InputError);
    CHECK_NOTHROW(unseen.see(2));
    CHECK_NOTHROW(unseen.see(3));
  }
}
