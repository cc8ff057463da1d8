#include "graph/analysis/partition.h"

#include <algorithm>
#include <numeric>

namespace jarol::analysis {
namespace {

constexpr std::size_t max_tests = 20'000;  // of a core in the search of all assignments

double use_of(const TaskModel& m) {
  return static_cast<double>(m.wcet.count()) / static_cast<double>(m.period.count());
}

// Tasks that go to one core together.
struct Together {
  std::vector<std::size_t> tasks;
  std::optional<std::size_t> core;
  double use = 0;
};

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Given ones first, then by utilisation. `connected`: tasks that follow each other are one; else each is alone.
std::vector<Together> groups_of(const System& system, bool connected) {
  const std::size_t n = system.models.size();
  std::vector<std::size_t> parent(n);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (const auto& [a, b] : system.follows)
    if (connected && !system.core[a] && !system.core[b]) parent[root_of(parent, a)] = root_of(parent, b);
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
    group.use += use_of(system.models[i]);
  }
  std::stable_sort(groups.begin(), groups.end(), [](const Together& a, const Together& b) {
    return std::tuple(!a.core.has_value(), -a.use) < std::tuple(!b.core.has_value(), -b.use);
  });
  return groups;
}

// Tasks by core.
struct Assigned {
  std::vector<std::vector<std::size_t>> tasks;
  std::vector<double> use;

  explicit Assigned(std::size_t count) : tasks(count), use(count, 0) {}
  void put(const Together& group, std::size_t core) {
    tasks[core].insert(tasks[core].end(), group.tasks.begin(), group.tasks.end());
    use[core] += group.use;
  }
  void take_back(const Together& group, std::size_t core) {
    tasks[core].resize(tasks[core].size() - group.tasks.size());
    use[core] -= group.use;
  }
  bool overflows(const Together& group, std::size_t core) const { return use[core] + group.use > 1 + 1e-9; }
  std::vector<std::size_t> of_tasks(std::size_t count) const {
    std::vector<std::size_t> core(count);
    for (std::size_t c = 0; c < tasks.size(); ++c)
      for (const std::size_t i : tasks[c]) core[i] = c;
    return core;
  }
};

class Assigner {
 public:
  Assigner(const System& system, const FitsCore& fits, const Holds& holds, Budget& budget)
      : system_(system), fits_(fits), holds_(holds), budget_(budget), count_(static_cast<std::size_t>(system.cores)) {}

  Partition assign() {
    const std::vector<Together> connected = groups_of(system_, true), alone = groups_of(system_, false);
    Partition partition;
    // by utilisation alone, and what does not fit where it does least harm: what a "no" reports
    partition.core = by_utilisation(connected).of_tasks(system_.models.size());
    if (holds(partition.core)) return found(partition.core);
    for (const auto& [groups, spread] :
         {std::pair(&connected, false), {&alone, false}, {&connected, true}, {&alone, true}}) {
      const auto cores = fit(*groups, spread);
      if (!cores) continue;
      const std::vector<std::size_t> core = cores->of_tasks(system_.models.size());
      if (holds(core)) return found(core);
    }
    Assigned cores(count_);
    if (search(alone, 0, true, cores)) return found(cores.of_tasks(system_.models.size()));
    partition.refuted = !open_;
    return partition;
  }

 private:
  static Partition found(std::vector<std::size_t> core) { return {std::move(core), true, false}; }

  bool holds(const std::vector<std::size_t>& core) {
    if (budget_.spent()) return false;
    const Verdict verdict = holds_(core, budget_);
    open_at_leaf_ = verdict == Verdict::unknown;
    return verdict == Verdict::schedulable;
  }

  Verdict fits(const std::vector<std::size_t>& tasks) {
    return budget_.spend(10 * tasks.size()) ? fits_(tasks, budget_) : Verdict::unknown;
  }

  Assigned by_utilisation(const std::vector<Together>& groups) const {
    Assigned cores(count_);
    for (const Together& group : groups) {
      std::size_t at = group.core.value_or(0);
      while (!group.core && at < count_ && cores.use[at] + group.use > 1) ++at;
      if (at == count_)
        at = static_cast<std::size_t>(std::min_element(cores.use.begin(), cores.use.end()) - cores.use.begin());
      cores.put(group, at);
    }
    return cores;
  }

  // Each on the first core that it fits, or on the least used one that it does (`spread`).
  std::optional<Assigned> fit(const std::vector<Together>& groups, bool spread) {
    Assigned cores(count_);
    std::vector<std::size_t> order(count_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (const Together& group : groups) {
      if (spread)
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return cores.use[a] < cores.use[b]; });
      bool placed = false, empty_tried = false;
      for (std::size_t k = 0; k < count_ && !placed; ++k) {
        const std::size_t c = order[k];
        if ((group.core && *group.core != c) || cores.overflows(group, c)) continue;
        if (cores.tasks[c].empty() && std::exchange(empty_tried, true) && !group.core) continue;
        cores.put(group, c);
        placed = fits(cores.tasks[c]) == Verdict::schedulable;
        if (!placed) cores.take_back(group, c);
      }
      if (!placed || budget_.spent()) return std::nullopt;
    }
    return cores;
  }

  // Depth first; a core that is still empty stands for all empty ones that nothing is bound to. `sure`: every core is
  // known to hold so far.
  bool search(const std::vector<Together>& groups, std::size_t at, bool sure, Assigned& cores) {
    if (at == groups.size()) {
      if (sure && holds(cores.of_tasks(system_.models.size()))) return true;
      open_ = open_ || !sure || open_at_leaf_ || budget_.spent();
      return false;
    }
    bool empty_tried = false;
    for (std::size_t c = 0; c < count_; ++c) {
      if (tests_ >= max_tests || budget_.spent()) {
        open_ = true;
        return false;
      }
      if ((groups[at].core && *groups[at].core != c) || cores.overflows(groups[at], c)) continue;
      // given ones come first, so that the empty ones are alike from there on
      if (!groups[at].core && cores.tasks[c].empty() && std::exchange(empty_tried, true)) continue;
      cores.put(groups[at], c);
      ++tests_;
      const Verdict verdict = fits(cores.tasks[c]);
      const bool still_sure = sure && verdict == Verdict::schedulable;
      const bool worth_it = verdict != Verdict::not_schedulable && (still_sure || !open_);
      if (worth_it && search(groups, at + 1, still_sure, cores)) return true;
      cores.take_back(groups[at], c);
    }
    return false;
  }

  const System& system_;
  const FitsCore& fits_;
  const Holds& holds_;
  Budget& budget_;
  std::size_t count_;
  bool open_ = false, open_at_leaf_ = false;  // there may be an assignment that holds
  std::size_t tests_ = 0;
};

bool all_given(const System& system) {
  return std::all_of(system.core.begin(), system.core.end(), [](const auto& core) { return core.has_value(); });
}

}  // namespace

Partition assign_cores(const System& system, const FitsCore& fits, const Holds& holds, Budget& budget) {
  Partition partition;
  for (std::size_t i = 0; i < system.models.size(); ++i)
    partition.core.push_back(system.cores == 1 ? 0 : static_cast<std::size_t>(system.core[i].value_or(0)));
  if (system.cores == 1 || all_given(system)) return partition;
  return Assigner(system, fits, holds, budget).assign();
}

void qualify_no(const System& system, const Partition& partition, Verdict& verdict, Evidence& evidence,
                std::string& reason) {
  if (verdict != Verdict::not_schedulable || system.cores == 1 || all_given(system)) return;
  const auto order = compare_utilisation(system.models, system.cores);
  if (order && *order > 0) return;
  if (partition.refuted) {
    reason += "; no assignment of tasks to cores holds";
    return;
  }
  verdict = Verdict::unknown;
  evidence = Evidence::none;
  reason += " with the cores that were assigned; another assignment may hold, which 'core:' per task may say";
}

}  // namespace jarol::analysis
