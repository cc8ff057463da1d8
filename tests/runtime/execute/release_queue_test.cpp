#include "runtime/state/release_queue.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

TEST_SUITE("runtime/release_queue") {
  using namespace jarol;

  // Instants and groups of the first `count` calls, as "instant: groups;".
  std::string first_calls(ReleaseQueue & queue, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
      text += std::to_string(queue.next().count()) + ":";
      for (const std::uint32_t group : queue.take()) text += " " + std::to_string(group);
      text += "; ";
    }
    return text;
  }

  TEST_CASE("groups are due at first, first + period and so on, those of one instant together") {
    ReleaseQueue queue;
    queue.add(Duration(0), Duration(4));
    queue.add(Duration(2), Duration(3));
    CHECK(first_calls(queue, 6) == "0: 0; 2: 1; 4: 0; 5: 1; 8: 0 1; 11: 1; ");
  }

  using Groups = std::vector<std::pair<std::int64_t, std::int64_t>>;  // first, period

  // At each instant before `end` the queue has just those groups that a look at all finds.
  void require_each_instant(const Groups& groups, std::int64_t end, bool reserved) {
    ReleaseQueue queue;
    if (reserved) queue.reserve(groups.size());
    for (const auto& [first, period] : groups) queue.add(Duration(first), Duration(period));
    for (std::int64_t instant = 0; instant < end; ++instant) {
      std::vector<std::uint32_t> expected;
      for (std::size_t g = 0; g < groups.size(); ++g)
        if (instant >= groups[g].first && (instant - groups[g].first) % groups[g].second == 0)
          expected.push_back(static_cast<std::uint32_t>(g));
      if (expected.empty()) {
        REQUIRE(queue.next().count() != instant);
        continue;
      }
      REQUIRE(queue.next().count() == instant);
      const auto due = queue.take();
      REQUIRE(std::vector<std::uint32_t>(due.begin(), due.end()) == expected);
    }
  }

  TEST_CASE("many groups are found by another way, and come the same") {
    for (const std::int64_t count : {5, 33, 200}) {
      Groups groups;
      for (std::int64_t g = 0; g < count; ++g) groups.emplace_back(g * 37 % 11, 1 + g * 53 % 17);
      require_each_instant(groups, 500, false);
    }
  }

  TEST_CASE("groups of any periods come in the order of time: alike, coprime, of nanoseconds and of hours") {
    Groups alike, coprime, far_apart, late;
    for (std::int64_t g = 0; g < 300; ++g) {
      alike.emplace_back(g % 7 * 1'000'000, (1 + g % 5) * 1'000'000);
      coprime.emplace_back(g * 31, 1'000'003 + g * 7919);
      far_apart.emplace_back(g % 2 == 0 ? g : 5, g % 2 == 0 ? 1000 + g : 3'600'000'000'000 + g);
      late.emplace_back(g == 0 ? 0 : 1'000'000'000'000'000, g == 0 ? 1'000'000'000'000 : 17 + g);
    }
    for (const Groups& groups : {alike, coprime, far_apart, late}) {
      ReleaseQueue queue;
      std::multimap<std::int64_t, std::uint32_t> expected;
      for (const auto& [first, period] : groups) {
        expected.emplace(first, static_cast<std::uint32_t>(expected.size()));
        queue.add(Duration(first), Duration(period));
      }
      for (int i = 0; i < 5000; ++i) {
        const std::int64_t instant = expected.begin()->first;
        std::vector<std::uint32_t> due;
        for (; expected.begin()->first == instant; expected.erase(expected.begin())) {
          const std::uint32_t group = expected.begin()->second;
          due.push_back(group);
          expected.emplace(instant + groups[group].second, group);
        }
        std::sort(due.begin(), due.end());
        REQUIRE(queue.next().count() == instant);
        const auto taken = queue.take();
        REQUIRE(std::vector<std::uint32_t>(taken.begin(), taken.end()) == due);
      }
    }
  }

  TEST_CASE("few groups come the same whether all of their pattern stands in a timetable, or it takes too long") {
    const Groups soon{{0, 2}, {1, 4}, {3, 6}}, begins_late{{0, 2}, {25, 6}, {7, 3}}, many_instants{{0, 2}, {0, 125}},
        just_fits{{0, 1}, {0, 128}}, one_too_many{{0, 1}, {0, 129}}, alone{{5, 7}};
    Groups crowded;  // 31 groups at each of 40 instants, and one more
    for (int g = 0; g < 31; ++g) crowded.emplace_back(0, 1);
    crowded.emplace_back(0, 40);
    for (const Groups& groups : {soon, begins_late, many_instants, just_fits, one_too_many, alone, crowded}) {
      CAPTURE(groups.size());
      require_each_instant(groups, 1000, true);
    }
  }

  TEST_CASE("a queue that is cleared forgets its timetable") {
    ReleaseQueue queue;
    queue.add(Duration(0), Duration(4));
    CHECK(first_calls(queue, 3) == "0: 0; 4: 0; 8: 0; ");
    queue.clear();
    queue.add(Duration(1), Duration(3));
    queue.add(Duration(1), Duration(2));
    CHECK(first_calls(queue, 4) == "1: 0 1; 3: 1; 4: 0; 5: 1; ");
  }

  TEST_CASE("what lies beyond 292 years never comes") {
    const std::int64_t century = 3'153'600'000'000'000'000;
    ReleaseQueue queue;
    queue.add(Duration(century), Duration(century));
    CHECK(first_calls(queue, 2) == "3153600000000000000: 0; 6307200000000000000: 0; ");
    CHECK(queue.next().count() == std::numeric_limits<std::int64_t>::max());
    ReleaseQueue many;
    for (int g = 0; g < 100; ++g) many.add(Duration(century + g), Duration(century));
    for (int i = 0; i < 200; ++i) static_cast<void>(many.take());
    CHECK(many.next().count() == std::numeric_limits<std::int64_t>::max());
  }

  TEST_CASE("without groups there is no next instant") {
    CHECK(ReleaseQueue().next().count() == std::numeric_limits<std::int64_t>::max());
  }
}
