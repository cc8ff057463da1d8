// Which task runs on which core, against every assignment that there is.
#include "graph/analysis/partition.h"

#include <doctest/doctest.h>

#include "graph/analysis/check.h"
#include "tests/how_many.h"

namespace {
using namespace jarol::analysis;
using namespace std::chrono_literals;
using jarol::Duration;
using jarol::Policy;
namespace policies = jarol::policies;

// splitmix64
std::int64_t drawn(std::uint64_t& state, std::int64_t min, std::int64_t max) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return min + static_cast<std::int64_t>((z ^ (z >> 31)) % static_cast<std::uint64_t>(max - min + 1));
}

// A few tasks on two cores, none of them given, offsets as drawn.
System random_system(std::uint64_t seed, const Policy& policy) {
  System system;
  system.policy = policy;
  system.cores = 2;
  const auto n = static_cast<std::size_t>(drawn(seed, 2, 5));
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t period = drawn(seed, 2, 7), wcet = drawn(seed, 1, period);
    system.models.push_back({.wcet = Duration(wcet),
                             .period = Duration(period),
                             .deadline = Duration(drawn(seed, wcet, period)),
                             .offset = Duration(drawn(seed, 0, period - 1))});
    system.rank.push_back(i);
    system.turn.push_back(i);
  }
  system.priority.resize(n);
  system.core.resize(n);
  return system;
}

// The best verdict of all assignments, each of them given.
Verdict best_assignment(System system) {
  bool open = false;
  Budget budget;
  for (unsigned bits = 0; bits < 1U << system.models.size(); ++bits) {
    for (std::size_t i = 0; i < system.models.size(); ++i) system.core[i] = bits >> i & 1;
    const Verdict verdict = verdict_of(system, budget);
    if (verdict == Verdict::schedulable) return verdict;
    open = open || verdict == Verdict::unknown;
  }
  return open ? Verdict::unknown : Verdict::not_schedulable;
}
}  // namespace

TEST_SUITE("graph/analysis/partition") {
  TEST_CASE("no is said of all assignments only where none is left that may hold") {
    int counts[] = {0, 0, 0};
    for (std::uint64_t seed = 0; seed < jarol::tests::how_many<std::uint64_t>(1000, 1000, 100); ++seed)
      for (const Policy& policy : {policies::edf, policies::fixed_priority, policies::edf_nonpreemptive,
                                   policies::fixed_priority_nonpreemptive}) {
        CAPTURE(seed);
        CAPTURE(policy.name);
        const System system = random_system(seed, policy);
        const Result result = check(system);
        ++counts[static_cast<int>(result.verdict)];
        REQUIRE(result.verdict == best_assignment(system));
      }
    CHECK(counts[static_cast<int>(Verdict::schedulable)] > 0);
    CHECK(counts[static_cast<int>(Verdict::not_schedulable)] > 0);
  }

  TEST_CASE("four hundred tasks find their cores among sixty-four") {
    for (const Policy& policy :
         {policies::table, policies::fixed_priority, policies::edf, policies::edf_nonpreemptive}) {
      CAPTURE(policy.name);
      System system;
      system.policy = policy;
      system.cores = 64;
      std::uint64_t seed = 7;
      const Duration periods[] = {5ms, 10ms, 20ms, 50ms, 100ms};
      for (std::size_t i = 0; i < 400; ++i) {
        const Duration period = periods[drawn(seed, 0, 4)], wcet = period * drawn(seed, 40, 120) / 1000;
        system.models.push_back({.wcet = wcet, .period = period, .deadline = period});
        system.rank.push_back(i);
        system.turn.push_back(i);
        if (i % 4 == 1 && system.models[i - 1].period == period) system.follows.emplace_back(i - 1, i);
      }
      system.priority.resize(400);
      system.core.resize(400);
      CHECK(utilisation(system.models) > 30);
      Budget budget{200'000'000};  // a second or two
      CHECK(verdict_of(system, budget) == Verdict::schedulable);
      CHECK(!budget.spent());
    }
  }

  TEST_CASE("of tasks that follow each other some go elsewhere, and no is said of all only after these too") {
    System system;
    system.policy = policies::fixed_priority;
    system.cores = 2;
    for (std::size_t i = 0; i < 4; ++i) {
      system.models.push_back({.wcet = i == 0 ? 1ns : 4ns, .period = 10ns, .deadline = 10ns});
      system.rank.push_back(i);
      system.turn.push_back(i);
      if (i > 0) system.follows.emplace_back(0, i);
    }
    system.priority.resize(4);
    system.core.resize(4);
    CHECK(check(system).verdict == Verdict::schedulable);
    for (std::size_t i = 1; i < 4; ++i) system.models[i].wcet = 6ns;
    const Result no = check(system);
    CHECK(no.verdict == Verdict::not_schedulable);
    CHECK(no.reason.ends_with("; no assignment of tasks to cores holds"));
  }
}
