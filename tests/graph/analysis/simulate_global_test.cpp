// Global earliest deadline first against a trial that counts single units of time and shares no code with it.
#include "graph/analysis/simulate_global.h"

#include <doctest/doctest.h>

#include <numeric>

#include "graph/analysis/check.h"
#include "graph/analysis/simulate.h"

namespace {
using namespace jarol::analysis;
using namespace std::chrono_literals;
using jarol::Duration;

// splitmix64
std::int64_t drawn_up_to(std::uint64_t& state, std::int64_t min, std::int64_t max) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return min + static_cast<std::int64_t>((z ^ (z >> 31)) % static_cast<std::uint64_t>(max - min + 1));
}

System random_system(std::uint64_t seed) {
  System system;
  system.policy = jarol::policies::global_edf;
  system.cores = drawn_up_to(seed, 2, 3);
  const auto n = static_cast<std::size_t>(system.cores + drawn_up_to(seed, 0, 3));
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t period = drawn_up_to(seed, 2, 6), wcet = drawn_up_to(seed, 1, period);
    system.models.push_back({.wcet = Duration(wcet),
                             .period = Duration(period),
                             .deadline = Duration(drawn_up_to(seed, wcet, period)),
                             .offset = Duration(drawn_up_to(seed, 0, period - 1))});
    system.rank.push_back(i);
    system.turn.push_back(i);
  }
  system.priority.resize(n);
  system.core.resize(n);
  return system;
}

// Is nothing late over many hyperperiods? `shorter`: execution times as drawn from it, up to the WCET.
bool trial_holds(const System& system, std::optional<std::uint64_t> shorter) {
  struct Job {
    std::size_t task;
    Duration deadline, left;
  };
  std::int64_t lcm = 1;
  for (const TaskModel& m : system.models) lcm = std::lcm(lcm, m.period.count());
  std::vector<Job> jobs;
  for (Duration now{}; now < Duration(10 * lcm + 10); ++now) {
    for (std::size_t i = 0; i < system.models.size(); ++i) {
      const TaskModel& m = system.models[i];
      if (now >= m.offset && (now - m.offset) % m.period == 0ns)
        jobs.push_back({i, now + m.deadline, shorter ? Duration(drawn_up_to(*shorter, 1, m.wcet.count())) : m.wcet});
    }
    std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) {
      return a.deadline != b.deadline ? a.deadline < b.deadline : a.task < b.task;
    });
    for (std::size_t c = 0; c < jobs.size() && c < static_cast<std::size_t>(system.cores); ++c) --jobs[c].left;
    for (const Job& job : jobs)
      if (job.left > 0ns && job.deadline <= now + 1ns) return false;
    std::erase_if(jobs, [](const Job& job) { return job.left == 0ns; });
  }
  return true;
}
}  // namespace

TEST_SUITE("graph/analysis/simulate_global") {
  TEST_CASE("with offsets that hold the verdict is exact, and shorter execution makes nothing late") {
    int yes = 0, no = 0, by_run = 0;
    for (std::uint64_t seed = 0; seed < 5000; ++seed) {
      CAPTURE(seed);
      System system = random_system(seed);
      const bool truth = trial_holds(system, std::nullopt);
      const Result result = check(system);
      REQUIRE(result.verdict == (truth ? Verdict::schedulable : Verdict::not_schedulable));
      const bool by_run_alone = !result.reason.starts_with("every task") && !result.reason.starts_with("the densities");
      REQUIRE(result.evidence == (by_run_alone ? Evidence::proof : Evidence::safe));
      ++(truth ? yes : no);
      by_run += result.reason.starts_with("every activation of the whole repetition") ? 1 : 0;
      if (truth) REQUIRE(trial_holds(system, seed));
      if (!truth) REQUIRE(result.late.has_value());
      // what holds whatever the offsets holds with these
      system.offsets_hold = false;
      Budget budget;
      if (verdict_of(system, budget) == Verdict::schedulable) REQUIRE(truth);
    }
    CHECK(yes > 500);
    CHECK(no > 500);
    CHECK(by_run > 200);
  }

  TEST_CASE("what would take too long is given up, and says nothing") {
    const System system = random_system(1);
    const GlobalSimulation run = simulate_global(system.models, system.cores, 3);
    CHECK(!run.repeats);
    CHECK(!run.late);
  }

  TEST_CASE("on a thousand cores a task that takes far too long is found late after one activation of it") {
    System system;
    system.policy = jarol::policies::global_edf;
    system.cores = 1024;
    system.models = {{.wcet = 100s, .period = 1ms, .deadline = 1ms}, {.wcet = 1ms, .period = 10ms, .deadline = 10ms}};
    system.rank = system.turn = {0, 1};
    system.priority.resize(2);
    system.core.resize(2);
    const Result result = check(system);
    CHECK(result.verdict == Verdict::not_schedulable);
    CHECK(result.evidence == Evidence::proof);
    CHECK(result.reason == "the tasks need more than all cores");
    system.models[0].wcet = 20ms;
    const Result soon = check(system);
    REQUIRE(soon.late);
    CHECK(soon.late->finish == 20ms);
    // a piece for each that runs, as long as it runs
    const auto first = std::find_if(soon.slices.begin(), soon.slices.end(),
                                    [](const Slice& s) { return s.task == 0 && s.activation == 0; });
    REQUIRE(first != soon.slices.end());
    CHECK(first->begin == 0ns);
    CHECK(first->end == 20ms);
  }

  TEST_CASE("what arrives while one activation runs for long is bounded, too") {
    constexpr std::uint64_t max = 1'000;
    const std::vector<TaskModel> models{{.wcet = 999h, .period = 1000h, .deadline = 1000h},
                                        {.wcet = 10us, .period = 1ms, .deadline = 1ms}};
    for (const Order order : {Order::by_priority, Order::by_deadline}) {
      const Simulation walked = simulate(models, order, false, 2000h, max);
      CHECK(!walked.whole);
      CHECK(walked.activations == max + 1);
    }
  }
}
