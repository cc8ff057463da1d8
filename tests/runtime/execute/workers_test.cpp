#include "runtime/dispatch/workers.h"

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <system_error>
#include <utility>
#include <vector>

#include "tests/refused_threads.h"

namespace {
using namespace jarol;

struct Sums {
  std::array<std::uint64_t, 8> parts{};  // plain: only the worker that has the part writes it
  std::uint64_t round = 0;
};

void add_round(void* context, std::size_t part) {
  auto& sums = *static_cast<Sums*>(context);
  sums.parts[part] += sums.round;
}
}  // namespace

TEST_SUITE("runtime/workers") {
  TEST_CASE("where the second thread can't be had the first ends, and the error is the caller's") {
    if (!tests::RefusedThreads::possible) return;
    const tests::RefusedThreads refused(1);
    CHECK_THROWS_AS(Workers(3, 3), std::system_error);
  }

  TEST_CASE("each part is done once in every round, and seen by the caller, with any number of workers") {
    for (const auto& pair : std::vector<std::pair<std::size_t, std::size_t>>{{1, 1}, {2, 2}, {3, 8}, {8, 8}}) {
      const std::size_t count = pair.first, parts = pair.second;
      CAPTURE(count);
      Workers workers(count, parts);
      CHECK(workers.count() == count);
      CHECK(workers.parts() == parts);
      Sums sums;
      constexpr std::uint64_t rounds = 20'000;  // on a busy machine fewer
      const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
      std::uint64_t total = 0;
      for (sums.round = 1; sums.round <= rounds && (sums.round < 100 || std::chrono::steady_clock::now() < end);
           ++sums.round) {
        workers.run(add_round, &sums);
        total += sums.round;
        bool equal = true;
        for (std::size_t p = 0; p < 8; ++p) equal = equal && sums.parts[p] == (p < parts ? total : 0);
        REQUIRE(equal);
      }
    }
  }

  TEST_CASE("workers that were never used end") {
    const Workers workers(4, 4);
    CHECK(workers.count() == 4);
  }
}
