// What pages are shown, kept for those that come late and those that are slow.
#include "tools/console/history.h"

#include <doctest/doctest.h>

#include <string>

namespace {
using namespace std::chrono_literals;
using jarol::tools::console::History;
}  // namespace

TEST_SUITE("console/history") {
  TEST_CASE("a page that is slow gets all of what ends") {
    History history(1 << 20, false);
    history.add("first");
    History::Place place = history.begin();
    CHECK(*history.next(place).text == "first");
    CHECK(history.next(place).text == nullptr);
    for (std::uint64_t i = 0; i < 2 * History::max_behind; ++i) history.add(std::to_string(i));
    for (std::uint64_t i = 0; i < 2 * History::max_behind; ++i) CHECK(*history.next(place).text == std::to_string(i));
    CHECK(place.missed == 0);
  }

  TEST_CASE("a page that comes late gets all that is there") {
    History history(100);
    history.add("one");
    history.add("two");
    History::Place place = history.begin();
    CHECK(*history.next(place).text == "one");
    CHECK(*history.next(place).text == "two");
    CHECK(history.next(place).text == nullptr);
    history.add("three");
    CHECK(*history.next(place).text == "three");
    CHECK(place.missed == 0);
  }

  TEST_CASE("the oldest go when there is no room, and who had not got them is informed") {
    History history(10);
    history.add("aaaa");
    History::Place place = history.begin();
    history.add("bbbb");
    history.add("cccc");
    CHECK(*history.next(place).text == "bbbb");
    CHECK(place.missed == 1);
    history.add(std::string(50, 'd'));
    CHECK(history.next(place).text->size() == 50);
    CHECK(place.missed == 2);
    CHECK(history.next(place).text == nullptr);
  }

  TEST_CASE("a page that has had what was there before it, and falls behind, goes on with the newest") {
    History history(1 << 20);
    History::Place slow = history.begin();
    for (std::uint64_t i = 0; i <= History::max_behind; ++i) history.add(std::to_string(i));
    History::Place late = history.begin();
    CHECK(*history.next(slow).text == std::to_string(History::max_behind));
    CHECK(slow.missed == History::max_behind);
    for (std::uint64_t i = 0; i <= History::max_behind; ++i) CHECK(*history.next(late).text == std::to_string(i));
    CHECK(late.missed == 0);
    for (std::uint64_t i = 0; i <= History::max_behind; ++i) history.add("more " + std::to_string(i));
    CHECK(*history.next(late).text == "more " + std::to_string(History::max_behind));
  }

  TEST_CASE("a page that is behind when all ends gets the last few") {
    History history(1 << 20);
    History::Place place = history.begin();
    for (int i = 0; i < 10; ++i) history.add(std::to_string(i));
    CHECK(*history.next(place).text == "0");
    for (const char* const last : {"7", "8", "9"}) CHECK(*history.next(place, true).text == last);
    CHECK(history.next(place, true).text == nullptr);
    CHECK(place.missed == 6);
  }

  TEST_CASE("of what time the next message is can be asked before it is taken") {
    History history(1 << 20);
    History::Place place = history.begin();
    CHECK(history.next_time(place) == nullptr);
    const History::Time first{1s}, second{2s};
    history.add("one", first);
    history.add("two", second);
    CHECK(*history.next_time(place) == first);
    CHECK(history.next(place).of == first);
    CHECK(*history.next_time(place) == second);
  }
}
