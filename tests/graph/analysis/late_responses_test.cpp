// Responses that are reported of sets that are not schedulable, against trials that count single units of time, let
// what is late end, and share no code with graph/analysis.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <numeric>
#include <random>
#include <tuple>

#include "tests/graph/analysis/judged.h"
#include "tests/graph/analysis/late_truth.h"
#include "tests/graph/graph_of.h"
#include "tests/how_many.h"

namespace {
using namespace jarol;
using analysis::Verdict;

struct Job {
  std::size_t task;
  int arrival, ready, left;
};

bool is_nonpreemptive(const Policy& policy) {
  return policy == policies::edf_nonpreemptive || policy == policies::fixed_priority_nonpreemptive;
}

bool is_by_priority(const Policy& policy) {
  return policy == policies::fixed_priority || policy == policies::fixed_priority_nonpreemptive;
}

// Each task on its core, or all on all cores under global EDF, with every WCET, shifts and jitter as drawn: the longest
// response of each task.
class Trial {
 public:
  Trial(const truth::Set& set, const std::vector<std::optional<std::size_t>>& core, std::uint64_t seed)
      : set_(set), core_(core), random_(seed), order_(truth::places_in(graph_of(set)).order) {}

  std::vector<int> run() {
    const std::size_t n = set_.tasks.size();
    std::vector<int> longest(n, 0), offset(n), next(n);
    int repetition = 1;
    for (std::size_t i = 0; i < n; ++i) {
      const truth::Task& t = set_.tasks[i];
      repetition = std::lcm(repetition, t.period);
      // what is connected moves together
      const int shift = set_.offsets_hold              ? 0
                        : set_.feeds.empty() || i == 0 ? below(t.period)
                                                       : offset[0] - set_.tasks[0].offset;
      next[i] = offset[i] = ((t.offset + shift) % t.period + t.period) % t.period;
    }
    std::vector<Job> jobs;
    for (int now = 0; now < 6 * repetition; ++now) {
      for (std::size_t i = 0; i < n; ++i) {
        const truth::Task& t = set_.tasks[i];
        if (now != next[i]) continue;
        jobs.push_back({i, now, now + (t.jitter > 0 ? below(t.jitter + 1) : 0), t.wcet});
        next[i] += t.period;
      }
      for (const std::size_t j : running(jobs, now)) {
        if (--jobs[j].left > 0) continue;
        int& response = longest[jobs[j].task];
        response = std::max(response, now + 1 - jobs[j].arrival);
      }
      std::erase_if(jobs, [](const Job& job) { return job.left == 0; });
    }
    return longest;
  }

 private:
  int below(int limit) { return static_cast<int>(random_() % static_cast<std::uint64_t>(limit)); }

  // Waits for the activation of a producer at its own instant, as readers of data flow do.
  bool waits(const std::vector<Job>& jobs, const Job& job) const {
    return std::any_of(set_.feeds.begin(), set_.feeds.end(), [&](const auto& feed) {
      return feed.second == job.task && !set_.tasks[feed.first].let &&
             std::any_of(jobs.begin(), jobs.end(),
                         [&](const Job& other) { return other.task == feed.first && other.arrival == job.arrival; });
    });
  }

  // The most urgent that are ready; of one task the earliest alone, and what has begun first where nothing preempts.
  std::vector<std::size_t> running(const std::vector<Job>& jobs, int now) const {
    std::vector<std::size_t> ready, runs;
    for (std::size_t j = 0; j < jobs.size(); ++j) {
      const bool is_next = std::none_of(jobs.begin(), jobs.begin() + static_cast<std::ptrdiff_t>(j),
                                        [&](const Job& other) { return other.task == jobs[j].task; });
      if (is_next && jobs[j].ready <= now && !waits(jobs, jobs[j])) ready.push_back(j);
    }
    const auto urgency = [&](std::size_t j) {
      const Job& job = jobs[j];
      const truth::Task& t = set_.tasks[job.task];
      const bool begun = is_nonpreemptive(set_.policy) && job.left < t.wcet;
      if (is_by_priority(set_.policy))
        return std::make_tuple(!begun, t.priority ? 0 : 1, t.priority.value_or(t.deadline), order_[job.task]);
      const std::size_t equal = set_.policy == policies::global_edf ? job.task : order_[job.task];
      return std::make_tuple(!begun, 0, job.arrival + t.deadline, equal);
    };
    std::sort(ready.begin(), ready.end(), [&](std::size_t a, std::size_t b) { return urgency(a) < urgency(b); });
    const bool global = set_.policy == policies::global_edf;
    std::vector<bool> taken(static_cast<std::size_t>(set_.cores), false);
    for (const std::size_t j : ready) {
      const auto free = global ? std::find(taken.begin(), taken.end(), false)
                               : taken.begin() + static_cast<std::ptrdiff_t>(core_[jobs[j].task].value());
      if (free == taken.end() || *free) continue;
      *free = true;
      runs.push_back(j);
    }
    return runs;
  }

  const truth::Set& set_;
  const std::vector<std::optional<std::size_t>>& core_;
  std::mt19937_64 random_;
  std::vector<std::size_t> order_;
};

struct Tally {
  std::uint64_t sets = 0, reported = 0, reached = 0, short_ones = 0;
  std::string first;

  void add(const truth::Set& set, std::uint64_t seed) {
    const analysis::Result said = analysis::check(graph_of(set));
    const bool global = set.policy == policies::global_edf;
    const bool placed = std::all_of(said.core.begin(), said.core.end(), [](const auto& c) { return c.has_value(); });
    if (said.verdict == Verdict::schedulable || (!global && !placed)) return;
    ++sets;
    std::vector<int> longest(set.tasks.size(), 0);
    for (std::uint64_t trial = 0; trial < 8; ++trial) {
      const std::vector<int> run = Trial(set, said.core, 8 * seed + trial).run();
      for (std::size_t i = 0; i < run.size(); ++i) longest[i] = std::max(longest[i], run[i]);
    }
    for (std::size_t i = 0; i < longest.size(); ++i) {
      if (!said.response[i]) continue;
      ++reported;
      reached += *said.response[i] == Duration(longest[i]) ? 1U : 0U;
      if (*said.response[i] >= Duration(longest[i])) continue;
      ++short_ones;
      if (first.empty())
        first = truth::Judged{set, said, {}}.text() + "\nbut task " + std::string(1, static_cast<char>('a' + i)) +
                " took " + std::to_string(longest[i]);
    }
  }
};

// As far as a set can be tried out whole.
struct WholeTally {
  std::uint64_t sets = 0, late = 0, responses = 0, exact = 0, reached = 0, wrong = 0;
  std::string first;

  void add(const truth::Set& set) {
    const Graph graph = graph_of(set);
    const analysis::Result said = analysis::check(graph);
    std::vector<std::size_t> core;
    for (const auto& c : said.core) core.push_back(c.value_or(0));
    const auto longest = late_truth_of(set, core, truth::places_in(graph), 5000);
    if (!longest) return;
    ++sets;
    late += said.verdict == Verdict::schedulable ? 0U : 1U;
    for (std::size_t i = 0; i < longest->size(); ++i) {
      if (!said.response[i]) continue;
      ++responses;
      const bool same = *said.response[i] == Duration((*longest)[i]);
      exact += said.exact[i] ? 1U : 0U;
      reached += same && !said.exact[i] ? 1U : 0U;
      if (said.exact[i] ? same : *said.response[i] >= Duration((*longest)[i])) continue;
      ++wrong;
      if (first.empty())
        first = truth::Judged{set, said, {}}.text() + "\nbut task " + std::string(1, static_cast<char>('a' + i)) +
                " took up to " + std::to_string((*longest)[i]);
    }
  }
};

// JAROL_SETS of each policy, else as many as there is time for.
std::uint64_t count_of_tried() {
  if (const char* count = std::getenv("JAROL_SETS")) return std::strtoull(count, nullptr, 10);
  return tests::how_many(20'000, 100'000, 500);
}
}  // namespace

TEST_SUITE("graph/analysis/late_responses") {
  TEST_CASE("no activation takes longer than the response that is reported, though others are late") {
    for (const Policy& policy : {policies::fixed_priority, policies::edf, policies::fixed_priority_nonpreemptive,
                                 policies::edf_nonpreemptive, policies::global_edf}) {
      const truth::Features features{
          .jitter = true, .blocking = false, .data_flow = true, .any_phasing = true, .cores = 2};
      Tally tally;
      const auto count = tests::how_many<std::uint64_t>(3000, 3000, 300);
      for (std::uint64_t seed = 0; seed < count; ++seed) tally.add(truth::random_set(seed, policy, features), seed);
      CAPTURE(policy.name);
      MESSAGE(tally.sets << " sets, " << tally.reported << " responses, " << tally.reached << " of these reached");
      CHECK(tally.sets > count / 30);
      CHECK_MESSAGE(tally.short_ones == 0, tally.first);
    }
  }

  TEST_CASE("a response that is exact is reached, and no other exceeded, whatever is late") {
    for (const Policy& policy : {policies::table, policies::fixed_priority, policies::edf,
                                 policies::fixed_priority_nonpreemptive, policies::edf_nonpreemptive}) {
      const truth::Features features{
          .jitter = true, .blocking = false, .data_flow = true, .any_phasing = true, .cores = 2};
      WholeTally tally;
      for (std::uint64_t seed = 0; seed < count_of_tried(); ++seed)
        tally.add(truth::random_set(seed, policy, features));
      CAPTURE(policy.name);
      MESSAGE(tally.sets << " sets, " << tally.late << " with something late; " << tally.responses << " responses, "
                         << tally.exact << " exact, " << tally.reached << " bounds that are reached");
      CHECK(tally.late > count_of_tried() / 50);
      CHECK(tally.exact > tally.sets / 10);
      CHECK_MESSAGE(tally.wrong == 0, tally.first);
    }
  }

  // Its bounds take for granted that the others end in time: 'e' had one of 6 ns and took 7, one in 50,000 random sets.
  TEST_CASE("under global EDF no response is reported where a task may be late") {
    const analysis::Result said = analysis::check(tests::graph_of(R"(graph: t
platform: {cores: 2, policy: global_edf}
tasks:
  a: {type: Counter, period: 6ns, wcet: 4ns}
  b: {type: Counter, period: 6ns, wcet: 1ns, jitter: 1ns}
  c: {type: Counter, period: 6ns, deadline: 3ns, wcet: 2ns, jitter: 1ns}
  d: {type: Counter, period: 6ns, wcet: 4ns}
  e: {type: Counter, period: 6ns, wcet: 1ns}
)"));
    CHECK(said.verdict == Verdict::not_schedulable);
    CHECK(said.response == std::vector<std::optional<Duration>>(5));
  }
}
