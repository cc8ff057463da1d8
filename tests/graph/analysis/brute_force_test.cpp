// Small random task sets: the analysis says what trying everything says. The trial shares no code with the analysis: it
// counts single units of time.
#include <doctest/doctest.h>

#include <functional>
#include <numeric>

#include "graph/analysis/check.h"
#include "tests/how_many.h"

namespace {
using namespace jarol;
using namespace jarol::analysis;

struct TimedSet {
  std::vector<std::int64_t> wcet, period, deadline, offset;
  std::size_t size() const { return wcet.size(); }
};

// splitmix64
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::int64_t up_to(std::int64_t min, std::int64_t max) {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return min + static_cast<std::int64_t>((z ^ (z >> 31)) % static_cast<std::uint64_t>(max - min + 1));
  }

 private:
  std::uint64_t state_;
};

std::string text_of(const TimedSet& set) {
  std::string text;
  for (std::size_t i = 0; i < set.size(); ++i)
    text += "C " + std::to_string(set.wcet[i]) + " T " + std::to_string(set.period[i]) + " D " +
            std::to_string(set.deadline[i]) + " O " + std::to_string(set.offset[i]) + "; ";
  return text;
}

TimedSet random_set(std::uint64_t seed) {
  Random random(seed);
  TimedSet set;
  const std::int64_t n = random.up_to(1, 3);
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t period = random.up_to(2, 7), wcet = random.up_to(1, std::max<std::int64_t>(1, period / 2 + 1));
    set.period.push_back(period);
    set.wcet.push_back(std::min(wcet, period));
    set.deadline.push_back(random.up_to(set.wcet.back(), period));
    set.offset.push_back(random.up_to(0, period - 1));
  }
  return set;
}

System timed_system(const TimedSet& set, const Policy& policy, bool offsets_hold) {
  System system;
  system.policy = policy;
  system.offsets_hold = offsets_hold;
  for (std::size_t i = 0; i < set.size(); ++i) {
    system.models.push_back({.wcet = Duration(set.wcet[i]),
                             .period = Duration(set.period[i]),
                             .deadline = Duration(set.deadline[i]),
                             .offset = Duration(offsets_hold ? set.offset[i] : 0)});
    system.rank.push_back(i);
    system.turn.push_back(i);
  }
  system.priority.resize(set.size());
  system.core.resize(set.size());
  return system;
}

bool is_preemptive(const Policy& policy) { return policy == policies::edf || policy == policies::fixed_priority; }
bool is_edf(const Policy& policy) { return policy == policies::edf || policy == policies::edf_nonpreemptive; }

// Unit by unit; `takes(task, activation)` is how long an activation runs. Longest responses, or nothing on a miss.
std::optional<std::vector<std::int64_t>> run(const TimedSet& set, const std::vector<std::int64_t>& offset,
                                             const Policy& policy,
                                             const std::function<std::int64_t(std::size_t, std::int64_t)>& takes) {
  struct Job {
    std::size_t task;
    std::int64_t release, left;
  };
  std::int64_t horizon = 1;
  for (const std::int64_t p : set.period) horizon = std::lcm(horizon, p);
  std::int64_t work = 0;
  for (std::size_t i = 0; i < set.size(); ++i) work += set.wcet[i] * (horizon / set.period[i]);
  if (work > horizon) return std::nullopt;  // somebody is late in the end
  horizon = 2 * horizon + *std::max_element(offset.begin(), offset.end());
  std::vector<Job> jobs;
  std::vector<std::int64_t> worst(set.size(), 0);
  std::size_t running = 0;
  bool busy = false;
  for (std::int64_t now = 0; now < horizon || !jobs.empty(); ++now) {
    for (std::size_t i = 0; i < set.size(); ++i)
      if (now < horizon && now >= offset[i] && (now - offset[i]) % set.period[i] == 0)
        if (const std::int64_t left = takes(i, (now - offset[i]) / set.period[i]); left > 0)
          jobs.push_back({i, now, left});
    if (jobs.empty()) continue;
    if (!busy || is_preemptive(policy)) {
      const auto urgency = [&](const Job& j) {
        const std::int64_t d = set.deadline[j.task];
        const bool table = policy == policies::table;
        return table ? std::tuple(j.release, std::int64_t{0}, j.task, j.release)
                     : std::tuple(is_edf(policy) ? j.release + d : d, std::int64_t{0}, j.task, j.release);
      };
      running = 0;
      for (std::size_t j = 1; j < jobs.size(); ++j)
        if (urgency(jobs[j]) < urgency(jobs[running])) running = j;
    }
    busy = true;
    for (const Job& j : jobs)
      if (now >= j.release + set.deadline[j.task]) return std::nullopt;
    if (--jobs[running].left > 0) continue;
    worst[jobs[running].task] = std::max(worst[jobs[running].task], now + 1 - jobs[running].release);
    jobs.erase(jobs.begin() + static_cast<std::ptrdiff_t>(running));
    busy = false;
  }
  return worst;
}

// Worst responses over every shift of the tasks, or nothing if one misses.
std::optional<std::vector<std::int64_t>> over_all_offsets(const TimedSet& set, const Policy& policy) {
  std::vector<std::int64_t> offset(set.size(), 0), worst(set.size(), 0);
  while (true) {
    const auto found = run(set, offset, policy, [&](std::size_t i, std::int64_t) { return set.wcet[i]; });
    if (!found) return std::nullopt;
    for (std::size_t i = 0; i < set.size(); ++i) worst[i] = std::max(worst[i], (*found)[i]);
    std::size_t i = 1;  // only shifts against the first matter
    while (i < set.size() && ++offset[i] == set.period[i]) offset[i++] = 0;
    if (i >= set.size()) return worst;
  }
}

std::uint64_t count_of_sets() { return tests::how_many(20'000, 20'000, 1'000); }

// Each task's activations take all, one unit or none, as `choice` says.
bool some_shorter_execution_misses(const TimedSet& set, const Policy& policy) {
  for (std::uint64_t choice = 0; choice < 729; ++choice) {
    const auto takes = [&](std::size_t i, std::int64_t k) -> std::int64_t {
      std::uint64_t digit = choice;
      for (std::size_t n = (i * 2 + static_cast<std::size_t>(k % 2)) % 6; n > 0; --n) digit /= 3;
      return digit % 3 == 0 ? set.wcet[i] : static_cast<std::int64_t>(digit % 3) - 1;
    };
    if (!run(set, set.offset, policy, takes)) return true;
  }
  return false;
}
}  // namespace

TEST_SUITE("graph/analysis/brute_force") {
  TEST_CASE("whatever the offsets: verdicts are exact, responses too under preemptive priorities") {
    for (std::uint64_t seed = 0; seed < count_of_sets(); ++seed) {
      const TimedSet set = random_set(seed);
      const std::string tasks = text_of(set);
      CAPTURE(tasks);
      for (const Policy& policy : {policies::fixed_priority, policies::edf, policies::fixed_priority_nonpreemptive,
                                   policies::edf_nonpreemptive}) {
        CAPTURE(policy.name);
        const auto truth = over_all_offsets(set, policy);
        const Result result = check(timed_system(set, policy, false));
        REQUIRE(result.verdict == (truth ? Verdict::schedulable : Verdict::not_schedulable));
        REQUIRE(result.evidence == Evidence::proof);
        if (!truth) continue;
        for (std::size_t i = 0; i < set.size(); ++i) {
          if (!result.response[i]) continue;
          // ties go against the task in the analysis, by order in the trial
          REQUIRE(*result.response[i] >= Duration((*truth)[i]));
          if (policy == policies::fixed_priority) REQUIRE(*result.response[i] == Duration((*truth)[i]));
        }
      }
    }
  }

  TEST_CASE("with offsets that hold: exact where it can be, never an unsafe yes") {
    int undecided = 0, by_shorter = 0, by_few_shorter = 0;
    for (std::uint64_t seed = 0; seed < count_of_sets(); ++seed) {
      const TimedSet set = random_set(seed);
      const std::string tasks = text_of(set);
      CAPTURE(tasks);
      for (const Policy& policy : {policies::table, policies::fixed_priority, policies::edf,
                                   policies::fixed_priority_nonpreemptive, policies::edf_nonpreemptive}) {
        CAPTURE(policy.name);
        const auto truth = run(set, set.offset, policy, [&](std::size_t i, std::int64_t) { return set.wcet[i]; });
        const Result result = check(timed_system(set, policy, true));
        if (result.verdict == Verdict::unknown) {
          ++undecided;
          continue;
        }
        REQUIRE(result.evidence == Evidence::proof);
        if (result.verdict == Verdict::not_schedulable) {
          // not interrupted, a shorter execution may be what makes another late
          if (truth) {
            REQUIRE(!is_preemptive(policy));
            REQUIRE(policy != policies::table);
            ++by_shorter;
            by_few_shorter += some_shorter_execution_misses(set, policy) ? 1 : 0;
          }
          continue;
        }
        REQUIRE(truth);
        if (seed % 20 == 0) REQUIRE(!some_shorter_execution_misses(set, policy));
        if (is_preemptive(policy) || policy == policies::table)
          for (std::size_t i = 0; i < set.size(); ++i) REQUIRE(*result.response[i] >= Duration((*truth)[i]));
      }
    }
    CHECK(undecided == 0);
    if (tests::tries_less) return;  // they are so rare that few sets show none
    // the few patterns that are tried find most of them
    CHECK(by_few_shorter > by_shorter / 2);
    CHECK(by_shorter > 0);
  }
}
