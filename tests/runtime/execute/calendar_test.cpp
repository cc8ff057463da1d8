#include "runtime/state/calendar.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

TEST_SUITE("runtime/calendar") {
  using namespace jarol;

  // Instants and groups of the first `count` calls, as "instant: groups;".
  std::string first_calls(Calendar & calendar, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
      text += std::to_string(calendar.next()) + ":";
      for (const std::uint32_t group : calendar.take()) text += " " + std::to_string(group);
      text += "; ";
    }
    return text;
  }

  TEST_CASE("groups are due at first, first + period and so on, those of one instant together") {
    Calendar calendar;
    calendar.add(0, 4);
    calendar.add(2, 3);
    CHECK(first_calls(calendar, 6) == "0: 0; 2: 1; 4: 0; 5: 1; 8: 0 1; 11: 1; ");
  }

  TEST_CASE("many groups are found by another way, and come the same") {
    for (const std::int64_t groups : {5, 33, 200}) {
      Calendar calendar;
      const auto first = [](std::int64_t g) { return g * 37 % 11; };
      const auto period = [](std::int64_t g) { return 1 + g * 53 % 17; };
      for (std::int64_t g = 0; g < groups; ++g) calendar.add(first(g), period(g));
      for (std::int64_t instant = 0; instant < 500; ++instant) {
        std::vector<std::uint32_t> expected;
        for (std::int64_t g = 0; g < groups; ++g)
          if (instant >= first(g) && (instant - first(g)) % period(g) == 0)
            expected.push_back(static_cast<std::uint32_t>(g));
        if (expected.empty()) {
          REQUIRE(calendar.next() != instant);
          continue;
        }
        REQUIRE(calendar.next() == instant);
        const auto due = calendar.take();
        REQUIRE(std::vector<std::uint32_t>(due.begin(), due.end()) == expected);
      }
    }
  }

  TEST_CASE("groups of any periods come in the order of time: alike, coprime, of nanoseconds and of hours") {
    using Groups = std::vector<std::pair<std::int64_t, std::int64_t>>;  // first, period
    Groups alike, coprime, far_apart, late;
    for (std::int64_t g = 0; g < 300; ++g) {
      alike.emplace_back(g % 7 * 1'000'000, (1 + g % 5) * 1'000'000);
      coprime.emplace_back(g * 31, 1'000'003 + g * 7919);
      far_apart.emplace_back(g % 2 == 0 ? g : 5, g % 2 == 0 ? 1000 + g : 3'600'000'000'000 + g);
      late.emplace_back(g == 0 ? 0 : 1'000'000'000'000'000, g == 0 ? 1'000'000'000'000 : 17 + g);
    }
    for (const Groups& groups : {alike, coprime, far_apart, late}) {
      Calendar calendar;
      std::multimap<std::int64_t, std::uint32_t> expected;
      for (const auto& [first, period] : groups) {
        expected.emplace(first, static_cast<std::uint32_t>(expected.size()));
        calendar.add(first, period);
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
        REQUIRE(calendar.next() == instant);
        const auto taken = calendar.take();
        REQUIRE(std::vector<std::uint32_t>(taken.begin(), taken.end()) == due);
      }
    }
  }

  TEST_CASE("what lies beyond 292 years never comes") {
    const std::int64_t century = 3'153'600'000'000'000'000;
    Calendar calendar;
    calendar.add(century, century);
    CHECK(first_calls(calendar, 2) == "3153600000000000000: 0; 6307200000000000000: 0; ");
    CHECK(calendar.next() == std::numeric_limits<std::int64_t>::max());
    Calendar many;
    for (int g = 0; g < 100; ++g) many.add(century + g, century);
    for (int i = 0; i < 200; ++i) static_cast<void>(many.take());
    CHECK(many.next() == std::numeric_limits<std::int64_t>::max());
  }

  TEST_CASE("without groups there is no next instant") {
    CHECK(Calendar().next() == std::numeric_limits<std::int64_t>::max());
  }
}
