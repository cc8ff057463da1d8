// Verdicts on times whose sums 63 bits do not hold: as on a thousandth of them.
#include <doctest/doctest.h>

#include <random>

#include "graph/analysis/check.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using analysis::Verdict;

// So many tasks, the first of which takes all of its period, under a policy and on so many cores.
Graph of_ten_years(const Policy& policy, int cores, int tasks, const std::string& wcet = "87600h") {
  std::string text =
      "graph: t\nplatform: {policy: " + std::string(policy.name) + ", cores: " + std::to_string(cores) + "}\ntasks:\n";
  for (int i = 0; i < tasks; ++i)
    text += "  t" + std::to_string(i) +
            ": {type: Counter, period: 87600h, let: 87600h, wcet: " + (i == 0 ? "87600h" : wcet) + "}\n";
  return tests::graph_of(text);
}

// A few short tasks, or many so long that their sum is beyond 63 bits; times in units.
class LongSet {
 public:
  LongSet(std::uint64_t seed, const Policy& policy) : random_(seed) {
    const bool many = below(2) == 0;
    const std::int64_t count = many ? 20 + below(60) : 1 + below(6);
    system_.policy = policy;
    system_.cores = 1 + below(2);
    system_.offsets_hold = below(2) == 0;
    const bool jitters = below(3) == 0, blocks = below(3) == 0, shifted = below(3) == 0;
    for (std::int64_t i = 0; i < count; ++i) {
      analysis::TaskModel m;
      m.period = Duration(12 / (1 + below(3)));
      m.deadline = 1ns + below(m.period);
      m.wcet = 1ns + below(many ? 26ns : 3ns);
      m.offset = shifted ? below(m.period) : 0ns;
      m.jitter = jitters ? below(m.period) : 0ns;
      m.blocking = blocks ? below(6ns) : 0ns;
      system_.models.push_back(m);
      system_.priority.push_back(std::nullopt);
      system_.core.push_back(below(2) == 0 ? std::optional(below(system_.cores)) : std::nullopt);
      system_.rank.push_back(system_.rank.size());
      system_.turn.push_back(system_.turn.size());
    }
  }

  analysis::System in(std::int64_t unit) const {
    analysis::System system = system_;
    for (analysis::TaskModel& m : system.models)
      for (Duration* time : {&m.period, &m.deadline, &m.wcet, &m.offset, &m.jitter, &m.blocking}) *time *= unit;
    return system;
  }

 private:
  std::int64_t below(std::int64_t limit) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(limit));
  }
  Duration below(Duration limit) { return Duration(below(limit.count())); }

  std::mt19937_64 random_;
  analysis::System system_;
};
}  // namespace

TEST_SUITE("graph/analysis/long_times") {
  TEST_CASE("tasks that need more time than 63 bits count need more than there is, under every policy") {
    for (const Policy& policy : analysis::built_in_policies())
      for (const int cores : {1, 2})
        for (const int tasks : {1, 2, 3, 28, 29, 30, 31, 58, 59, 60, 117, 118, 600}) {
          const std::string of =
              std::string(policy.name) + ", " + std::to_string(tasks) + " tasks on " + std::to_string(cores) + " cores";
          CAPTURE(of);
          const analysis::Result result = analysis::check(of_ten_years(policy, cores, tasks));
          // tables of ten years are not walked
          CHECK((result.verdict == Verdict::not_schedulable) == (tasks > cores));
          if (tasks > cores) CHECK(result.evidence == analysis::Evidence::proof);
        }
  }

  TEST_CASE("a nanosecond too much is too much beside ten years, under every policy") {
    for (const Policy& policy : analysis::built_in_policies()) {
      CAPTURE(policy.name);
      CHECK(analysis::check(of_ten_years(policy, 1, 2, "1ns")).verdict == Verdict::not_schedulable);
    }
  }

  TEST_CASE("work that is due is summed as far as there are times, and is the longest of them from there on") {
    for (const Policy& policy : {policies::edf, policies::edf_nonpreemptive}) {
      CAPTURE(policy.name);
      const auto demand = analysis::check(of_ten_years(policy, 1, 29)).demand;
      REQUIRE(demand);
      CHECK(demand->length == 87600h);
      CHECK(demand->demand == 29 * demand->length);
      const auto longer = analysis::check(of_ten_years(policy, 1, 30)).demand;
      REQUIRE(longer);
      CHECK(longer->length == demand->length);
      CHECK(longer->demand == Duration::max());
    }
  }

  TEST_CASE("a release each nanosecond of what takes ten years is too much for a core") {
    // so many that their sum is below zero in 128 bits, whatever the interval
    std::string tasks = "tasks:\n";
    for (int i = 0; i < 1'100; ++i)
      tasks += "  t" + std::to_string(i) + ": {type: Counter, period: " + (i == 0 ? "87600h" : "1ns") +
               ", wcet: 87600h, jitter: 87600h}\n";
    for (const std::string policy : {"edf", "edf_nonpreemptive"}) {
      CAPTURE(policy);
      const analysis::Result result =
          analysis::check(tests::graph_of("graph: t\nplatform: {policy: " + policy + "}\n" + tasks));
      CHECK(result.verdict == Verdict::not_schedulable);
      CHECK(result.evidence == analysis::Evidence::proof);
    }
  }

  TEST_CASE("sets of years are judged as the same sets of microseconds, and respond as long") {
    constexpr std::int64_t short_unit = 1'000, long_unit = (std::int64_t{1} << 57) / 12;
    for (const Policy& policy : analysis::built_in_policies())
      for (std::uint64_t seed = 0; seed < 150; ++seed) {
        CAPTURE(policy.name);
        CAPTURE(seed);
        const LongSet set(seed, policy);
        const analysis::Result brief = analysis::check(set.in(short_unit)), years = analysis::check(set.in(long_unit));
        CHECK(years.verdict == brief.verdict);
        CHECK(years.evidence == brief.evidence);
        CHECK(years.reason == brief.reason);
        // of equal utilisations another may round up
        for (std::size_t i = 0; i < brief.response.size() && years.core == brief.core; ++i) {
          // what can't be interrupted has begun a nanosecond before, in either unit
          const auto units = [&](const analysis::Result& r, std::int64_t unit) {
            return r.response[i] ? (r.response[i]->count() + unit / 2) / unit : -1;
          };
          CHECK(units(years, long_unit) == units(brief, short_unit));
        }
      }
  }
}
