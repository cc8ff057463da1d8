#include "graph/analysis/partition.h"

#include <algorithm>
#include <numeric>

namespace jarol::analysis {
namespace {

constexpr std::size_t most_searched = 12;   // groups that are assigned by exact search
constexpr std::size_t most_tests = 20'000;  // of a core in that search
constexpr std::size_t most_tested = 300;    // tasks

// Tasks that go to one core together.
struct Together {
  std::vector<std::size_t> tasks;
  std::optional<std::size_t> core;
  double utilisation = 0;
};

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

std::vector<Together> groups_of(const System& system) {
  const std::size_t n = system.loads.size();
  std::vector<std::size_t> parent(n);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (const auto& [a, b] : system.follows)
    if (!system.core[a] && !system.core[b]) parent[root_of(parent, a)] = root_of(parent, b);
  std::vector<Together> groups;
  std::vector<std::size_t> index(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t root = root_of(parent, i);
    if (index[root] == n) {
      index[root] = groups.size();
      groups.emplace_back();
    }
    Together& group = groups[index[root]];
    group.tasks.push_back(i);
    if (system.core[i]) group.core = static_cast<std::size_t>(*system.core[i]);
    group.utilisation += static_cast<double>(system.loads[i].wcet) / static_cast<double>(system.loads[i].period);
  }
  std::stable_sort(groups.begin(), groups.end(), [](const Together& a, const Together& b) {
    return std::tuple(!a.core.has_value(), -a.utilisation) < std::tuple(!b.core.has_value(), -b.utilisation);
  });
  return groups;
}

void append(std::vector<std::size_t>& to, const std::vector<std::size_t>& tasks) {
  to.insert(to.end(), tasks.begin(), tasks.end());
}

// Depth first; a core that is still empty stands for all empty ones.
struct Search {
  const std::vector<Together>& groups;
  const FitsCore& fits;
  std::vector<std::vector<std::size_t>> cores;
  bool open = false;  // there may be an assignment that holds
  std::size_t tests = 0;

  // `sure`: every core is known to hold so far.
  bool from(std::size_t at, bool sure) {
    if (at == groups.size()) {
      open = open || !sure;
      return sure;
    }
    bool empty_tried = false;
    for (std::size_t c = 0; c < cores.size(); ++c) {
      if (tests >= most_tests) {
        open = true;
        return false;
      }
      if (groups[at].core && *groups[at].core != c) continue;
      if (cores[c].empty() && !groups[at].core) {
        if (empty_tried) continue;
        empty_tried = true;
      }
      const std::vector<std::size_t> before = cores[c];
      append(cores[c], groups[at].tasks);
      ++tests;
      const Verdict verdict = fits(cores[c]);
      const bool still_sure = sure && verdict == Verdict::schedulable;
      const bool worth_it = verdict != Verdict::not_schedulable && (still_sure || !open);
      if (worth_it && from(at + 1, still_sure)) return true;
      cores[c] = before;
    }
    return false;
  }
};

}  // namespace

Partition assign_cores(const System& system, const FitsCore& fits_core) {
  if (system.cores == 1) return {std::vector<std::size_t>(system.loads.size(), 0), true, false};
  // the test of a core after each of very many tasks would take long
  const FitsCore by_utilisation = [&](const std::vector<std::size_t>& tasks) {
    Loads loads;
    for (const std::size_t i : tasks) loads.push_back(system.loads[i]);
    return utilisation(loads) <= 1 ? Verdict::schedulable : Verdict::unknown;
  };
  const FitsCore& fits = system.loads.size() <= most_tested ? fits_core : by_utilisation;
  const std::vector<Together> groups = groups_of(system);
  std::vector<std::vector<std::size_t>> cores(static_cast<std::size_t>(system.cores));
  Partition partition;
  partition.fits = true;
  for (const Together& group : groups) {
    bool placed = false;
    for (std::size_t c = 0; c < cores.size() && !placed; ++c) {
      if (group.core && *group.core != c) continue;
      std::vector<std::size_t> with = cores[c];
      append(with, group.tasks);
      placed = fits(with) == Verdict::schedulable;
      if (placed) cores[c] = std::move(with);
    }
    if (placed) continue;
    partition.fits = false;
    // where it does least harm
    std::size_t least = group.core.value_or(0);
    const auto load = [&](std::size_t c) {
      double sum = 0;
      for (const std::size_t i : cores[c])
        sum += static_cast<double>(system.loads[i].wcet) / static_cast<double>(system.loads[i].period);
      return sum;
    };
    for (std::size_t c = 0; c < cores.size() && !group.core; ++c)
      if (load(c) < load(least)) least = c;
    append(cores[least], group.tasks);
  }
  const auto is_free = [](const Together& g) { return !g.core.has_value(); };
  const auto free = static_cast<std::size_t>(std::count_if(groups.begin(), groups.end(), is_free));
  if (!partition.fits && free <= most_searched) {
    Search search{groups, fits, std::vector<std::vector<std::size_t>>(cores.size())};
    partition.fits = search.from(0, true);
    partition.refuted = !partition.fits && !search.open;
    if (partition.fits) cores = std::move(search.cores);
  }
  partition.core.resize(system.loads.size());
  for (std::size_t c = 0; c < cores.size(); ++c)
    for (const std::size_t i : cores[c]) partition.core[i] = c;
  return partition;
}

}  // namespace jarol::analysis
