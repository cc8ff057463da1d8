#include "graph/analysis/fifo_bound.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace jarol::analysis {
namespace {

// Tasks of cores that wait for each other.
std::vector<std::vector<std::size_t>> parts_of(const System& system, const std::vector<std::size_t>& core) {
  std::vector<std::size_t> part(static_cast<std::size_t>(system.cores));
  std::iota(part.begin(), part.end(), std::size_t{0});
  const auto join = [&](std::size_t a, std::size_t b) {
    const std::size_t from = part[a], to = part[b];
    std::replace(part.begin(), part.end(), from, to);
  };
  for (const auto& [producer, reader] : system.follows) join(core[producer], core[reader]);
  std::vector<std::vector<std::size_t>> parts(part.size());
  for (std::size_t i = 0; i < system.models.size(); ++i) parts[part[core[i]]].push_back(i);
  return parts;
}

struct Part {
  const System& system;
  const std::vector<std::size_t>& tasks;
  Duration jitter{};     // the longest
  long double used = 0;  // utilisation
  Wide all = 0;          // ns, one activation of each

  Part(const System& s, const std::vector<std::size_t>& t) : system(s), tasks(t) {
    for (const std::size_t i : tasks) {
      jitter = std::max(jitter, s.models[i].jitter);
      used += static_cast<long double>(cost(i).count()) / static_cast<long double>(s.models[i].period.count());
      all += cost(i).count();
    }
  }

  Duration cost(std::size_t i) const { return system.models[i].wcet + system.models[i].blocking; }

  // How long before an arrival of `own` the nearest of `other` that goes before it can be.
  Duration nearest(std::size_t own, std::size_t other) const {
    if (own == other) return {};
    const TaskModel &a = system.models[own], &b = system.models[other];
    const Duration gcd(std::gcd(a.period.count(), b.period.count()));
    const Duration apart = ((a.offset - b.offset) % gcd + gcd) % gcd;
    return apart == Duration{} && system.turn[other] > system.turn[own] ? gcd : apart;
  }

  std::optional<Duration> bound(std::size_t own, Budget& budget) const {
    using Arrival = std::pair<Duration, std::size_t>;  // how long before, of which task
    std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> before;
    for (const std::size_t i : tasks) before.emplace(nearest(own, i), i);
    // from there on the line of utilisation lies below what was found
    const long double line = static_cast<long double>(all) / (1 - used) * (1 + 1e-9L);
    if (line > static_cast<long double>(max_time.count())) return std::nullopt;
    const Duration reach(static_cast<std::int64_t>(line) + 1);
    Wide sum = 0, max = 0;
    while (before.top().first <= reach) {
      if (!budget.spend(10)) return std::nullopt;
      const auto [back, i] = before.top();
      before.pop();
      sum += cost(i).count();
      max = std::max(max, sum - back.count());
      before.emplace(back + system.models[i].period, i);
    }
    return std::min(saturated(jitter.count() + max), max_time);
  }
};

}  // namespace

std::vector<Duration> fifo_bounds(const System& system, const std::vector<std::size_t>& core, Budget& budget) {
  constexpr std::uint64_t max_steps = 20'000'000;
  std::vector<Duration> bounds(system.models.size());
  Budget own{std::min(budget.left, max_steps)};
  const std::uint64_t given = own.left;
  bool hold = true;
  for (const std::vector<std::size_t>& tasks : parts_of(system, core)) {
    if (tasks.empty() || !hold) continue;
    const Part part(system, tasks);
    hold = part.used < 1 - 1e-9L;
    // what holds for each with one activation of all before it needs no look at each
    Duration shortest = Duration::max();
    for (const std::size_t i : tasks) shortest = std::min(shortest, system.models[i].deadline);
    const bool all_fit = part.jitter.count() + part.all <= shortest.count();
    for (const std::size_t i : tasks) {
      if (!hold) break;
      std::optional<Duration> bound;
      if (all_fit && tasks.size() > 300)
        bound = saturated(part.jitter.count() + part.all);
      else
        bound = part.bound(i, own);
      hold = bound && *bound <= system.models[i].deadline;
      if (hold) bounds[i] = *bound;
    }
  }
  budget.spend(given - own.left);
  if (!hold) bounds.clear();
  return bounds;
}

}  // namespace jarol::analysis
