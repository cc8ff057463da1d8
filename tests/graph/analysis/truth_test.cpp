// What `check` says of small random sets, against what is true of them.
#include "tests/graph/analysis/truth.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "tests/graph/analysis/judged.h"
#include "tests/graph/graph_of.h"
#include "tests/how_many.h"

namespace {
using namespace jarol;
using analysis::Verdict;
using truth::Judged;
using truth::Set;
using Answer = truth::Truth::Answer;

// JAROL_SETS of each policy, else as many as there is time for.
std::uint64_t count_of_judged() {
  if (const char* count = std::getenv("JAROL_SETS")) return std::strtoull(count, nullptr, 10);
  return tests::how_many(20'000, 100'000, 1'500);
}

// Of a hundred sets, so many may be left open; measured: 0, 1.4, 1.6, 2.5, 1.8 and 9.3 of 100,000.
std::uint64_t max_unknown(const Policy& policy) {
  return policy == policies::table ? 0 : policy == policies::global_edf ? 10 : 3;
}

// How hard a wrong answer is to read.
std::size_t size_of(const Set& set) {
  std::size_t size = 100 * set.tasks.size() + 10 * set.feeds.size();
  for (const truth::Task& t : set.tasks)
    size +=
        static_cast<std::size_t>(t.period + t.offset + t.wcet + 2 * (t.jitter + t.blocking)) + (t.priority ? 3U : 0U);
  return size;
}

struct Tally {
  std::uint64_t sets = 0, decidable = 0, schedulable = 0, unknown = 0, safe_no = 0, responses = 0, exact = 0;
  std::map<std::string, std::uint64_t> wrong;        // by kind
  std::map<std::string, std::optional<Judged>> min;  // the smallest of each kind

  void add(const Judged& judged) {
    ++sets;
    if (!judged.decidable()) return;
    ++decidable;
    schedulable += judged.truth.answer == Answer::schedulable ? 1U : 0U;
    unknown += judged.says(Verdict::unknown) ? 1U : 0U;
    for (std::size_t i = 0; i < judged.set.tasks.size() && judged.says(Verdict::schedulable); ++i) {
      responses += judged.said.response[i] ? 1U : 0U;
      exact += judged.said.response[i] && judged.said.exact[i] ? 1U : 0U;
    }
    const std::string kind = judged.wrong();
    safe_no +=
        kind.empty() && judged.says(Verdict::not_schedulable) && judged.truth.answer == Answer::schedulable ? 1U : 0U;
    if (kind.empty()) return;
    ++wrong[kind];
    auto& known = min[kind];
    if (!known || size_of(judged.set) < size_of(known->set)) known = judged;
  }

  void print(const Policy& policy) {
    std::printf(
        "%s: %llu sets, %llu decidable, %llu schedulable; unsafe yes %llu, false proofs %llu, short responses "
        "%llu; unknown %llu, no without proof that is yes %llu; %llu responses, %llu exact, not reached %llu\n",
        std::string(policy.name).c_str(), static_cast<unsigned long long>(sets),
        static_cast<unsigned long long>(decidable), static_cast<unsigned long long>(schedulable),
        static_cast<unsigned long long>(wrong["unsafe yes"]), static_cast<unsigned long long>(wrong["false proof"]),
        static_cast<unsigned long long>(wrong["short response"]), static_cast<unsigned long long>(unknown),
        static_cast<unsigned long long>(safe_no), static_cast<unsigned long long>(responses),
        static_cast<unsigned long long>(exact), static_cast<unsigned long long>(wrong["response that is not reached"]));
  }
};
}  // namespace

TEST_SUITE("graph/analysis/truth") {
  TEST_CASE("no yes is unsafe, no proof of a no is false, and a response that is exact is reached") {
    for (const Policy& policy : analysis::built_in_policies()) {
      Tally tally;
      for (std::uint64_t seed = 0; seed < count_of_judged(); ++seed)
        tally.add(truth::judge(truth::random_set(seed, policy, {})));
      tally.print(policy);
      CHECK(tally.unknown <= max_unknown(policy) * tally.sets / 100);
      CHECK(tally.decidable > 95 * tally.sets / 100);
      for (const auto& [kind, judged] : tally.min)
        FAIL_CHECK(std::string(policy.name), ": ", tally.wrong[kind], " of kind ", kind, ", such as\n", judged->text());
    }
  }

  TEST_CASE("a set's graph is what the loader makes of its text") {
    for (std::uint64_t seed = 0; seed < 300; ++seed)
      for (const Policy& policy : {policies::table, policies::edf}) {
        const Set set = truth::random_set(seed, policy, {});
        const std::string text = truth::yaml_of(set, "ns");
        CAPTURE(text);
        const Graph loaded = tests::graph_of(text), made = truth::graph_of(set);
        REQUIRE(loaded.order == made.order);
        REQUIRE(loaded.tasks.size() == made.tasks.size());
        for (std::size_t i = 0; i < made.tasks.size(); ++i) {
          REQUIRE(loaded.tasks[i].deadline == made.tasks[i].deadline);
          REQUIRE(loaded.tasks[i].let == made.tasks[i].let);
          REQUIRE(loaded.tasks[i].task_class == made.tasks[i].task_class);
        }
        REQUIRE(loaded.connections.size() == made.connections.size());
        for (std::size_t i = 0; i < made.connections.size(); ++i) {
          REQUIRE(loaded.connections[i].from.index == made.connections[i].from.index);
          REQUIRE(loaded.connections[i].to.index == made.connections[i].to.index);
          REQUIRE(loaded.connections[i].to.field == made.connections[i].to.field);
        }
        REQUIRE(analysis::check(loaded).verdict == analysis::check(made).verdict);
      }
  }
}
