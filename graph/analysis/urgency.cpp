#include "graph/analysis/urgency.h"

#include <algorithm>
#include <tuple>

namespace jarol::analysis {

bool more_urgent(const System& s, std::size_t a, std::size_t b) {
  const auto key = [&](std::size_t i) {
    return std::tuple(!s.priority[i].has_value(), s.priority[i].value_or(s.models[i].deadline.count()), s.rank[i]);
  };
  return key(a) < key(b);
}

std::vector<std::size_t> in_order(const System& system, std::vector<std::size_t> tasks) {
  const bool by_priority = system.policy.urgency == Urgency::priority;
  std::sort(tasks.begin(), tasks.end(), [&](std::size_t a, std::size_t b) {
    return by_priority ? more_urgent(system, a, b) : system.rank[a] < system.rank[b];
  });
  return tasks;
}

}  // namespace jarol::analysis
