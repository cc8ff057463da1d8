// Response times of fixed priorities, beyond deadlines too, against published ones and a walk nanosecond by nanosecond.
#include "graph/analysis/fixed_priority.h"

#include <doctest/doctest.h>

#include <random>
#include <sstream>

namespace {
using namespace jarol::analysis;
using jarol::Duration;
using namespace std::chrono_literals;

using Responses = std::vector<std::optional<Duration>>;

Responses responses(const TaskModels& models, bool preemptive = true) {
  Budget budget;
  return fixed_priority_responses(models, preemptive, budget);
}

// Jobs of one task: they arrive at -J, T - J, ... and are released at 0, or when they arrive.
struct Jobs {
  const TaskModel& model;
  std::int64_t begun = 0;  // the first that has not ended
  Duration left{};         // of it

  Duration arrival() const { return begun * model.period - model.jitter; }
  bool is_ready(Duration now) const { return arrival() <= now; }
};

// The worst response of the last of `models` until there is nothing left to do, from where all are released at once and
// something else runs first for that long.
Duration walk(std::span<const TaskModel> models, bool preemptive, Duration blocking) {
  std::vector<Jobs> jobs;
  for (const TaskModel& model : models) jobs.push_back({model, 0, model.wcet});
  Duration worst{};
  Jobs* running = nullptr;
  for (Duration now = blocking;; ++now) {
    if (running == nullptr || preemptive) {
      const auto ready = std::find_if(jobs.begin(), jobs.end(), [&](const Jobs& j) { return j.is_ready(now); });
      if (ready == jobs.end()) return worst;
      running = &*ready;
    }
    if (--running->left > 0ns) continue;
    if (running == &jobs.back()) worst = std::max(worst, now + 1ns - running->arrival());
    ++running->begun;
    running->left = running->model.wcet;
    running = nullptr;
  }
}

std::string text_of(const TaskModels& models) {
  std::ostringstream text;
  for (const TaskModel& m : models)
    text << m.wcet.count() << "/" << m.period.count() << " J " << m.jitter.count() << " B " << m.blocking.count()
         << "; ";
  return text.str();
}
}  // namespace

TEST_SUITE("graph/analysis/fixed_priority") {
  TEST_CASE("the worst response may be that of a later activation of the busy period") {
    // Lehoczky 1990: the second task's are 114, 102, 116, 104, 118, 106, 94
    CHECK(responses({{.wcet = 26ns, .period = 70ns}, {.wcet = 62ns, .period = 100ns}}) == Responses{26ns, 118ns});
    CHECK(responses({{.wcet = 52ns, .period = 100ns}, {.wcet = 52ns, .period = 140ns}}) == Responses{52ns, 156ns});
  }

  TEST_CASE("responses of random sets are those of a walk through their busy periods") {
    std::mt19937 random(5);
    const auto upto = [&](std::int64_t max) { return static_cast<std::int64_t>(random() % (max + 1)); };
    int later = 0;
    for (int i = 0; i < 3000; ++i) {
      TaskModels models;
      const bool preemptive = i % 2 == 0;
      for (std::int64_t left = 1 + upto(3); left > 0; --left) {
        const std::int64_t period = 3 + upto(25);
        models.push_back({.wcet = Duration(1 + upto(period / 2)),
                          .period = Duration(period),
                          .jitter = Duration(upto(2) == 0 ? upto(2 * period) : 0),
                          .blocking = Duration(upto(3) == 0 ? upto(6) : 0)});
      }
      if (utilisation(models) > 1 - 1e-9) continue;
      CAPTURE(preemptive);
      CAPTURE(text_of(models));
      const Responses found = responses(models, preemptive);
      for (std::size_t k = 0; k < models.size(); ++k) {
        // what is less urgent has begun a nanosecond before
        Duration blocking = models[k].blocking;
        for (std::size_t below = k + 1; below < models.size() && !preemptive; ++below)
          blocking = std::max(blocking, models[below].wcet - 1ns);
        const Duration walked = walk(std::span(models).first(k + 1), preemptive, blocking);
        REQUIRE(found[k] == walked);
        later += walked - models[k].jitter > models[k].period;
      }
    }
    CHECK(later > 100);
  }
}
