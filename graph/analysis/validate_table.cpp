#include "graph/analysis/validate_table.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace jarol::analysis {

std::string fault_of_table(const System& system, const std::vector<std::size_t>& core, std::vector<Slice> slices,
                           Duration end, Duration repetition) {
  const auto named = [](std::size_t task, std::int64_t activation) {
    return "task " + std::to_string(task) + " activation " + std::to_string(activation);
  };
  std::map<std::pair<std::size_t, std::int64_t>, const Slice*> found;
  for (const Slice& s : slices)
    if (!found.emplace(std::pair(s.task, s.activation), &s).second)
      return named(s.task, s.activation) + " stands twice";
  // each where it belongs
  for (std::size_t i = 0; i < system.models.size(); ++i) {
    const TaskModel& m = system.models[i];
    for (std::int64_t k = 0; m.offset + k * m.period < end; ++k) {
      const auto at = found.find({i, k});
      if (at == found.end()) return named(i, k) + " is missing";
      const Slice& s = *at->second;
      const Duration release = m.offset + k * m.period;
      if (s.end - s.begin < m.wcet + m.blocking) return named(i, k) + " is cut short";
      if (s.begin < release + m.jitter) return named(i, k) + " begins before its release";
      if (s.end > release + m.deadline) return named(i, k) + " ends after its deadline";
    }
  }
  for (const auto& [producer, reader] : system.follows)
    for (const Slice& s : slices) {
      if (s.task != reader) continue;
      const TaskModel &p = system.models[producer], &r = system.models[reader];
      const Duration since = r.offset + s.activation * r.period - p.offset;
      if (since < Duration{} || since % p.period != Duration{}) continue;
      const auto at = found.find({producer, since / p.period});
      if (at != found.end() && at->second->end > s.begin)
        return named(s.task, s.activation) + " begins before the one that it follows has ended";
    }
  std::sort(slices.begin(), slices.end(), [&](const Slice& a, const Slice& b) {
    return std::tuple(core[a.task], a.begin, a.end) < std::tuple(core[b.task], b.begin, b.end);
  });
  for (std::size_t i = 1; i < slices.size(); ++i)
    if (core[slices[i].task] == core[slices[i - 1].task] && slices[i].begin < slices[i - 1].end)
      return named(slices[i].task, slices[i].activation) + " begins while another runs on its core";
  // what each core has left to do of all that arrived before an instant
  const auto backlog = [&](Duration instant) {
    std::vector<Duration> left(core.empty() ? 0 : *std::max_element(core.begin(), core.end()) + 1);
    for (const Slice& s : slices)
      if (const TaskModel& m = system.models[s.task]; m.offset + s.activation * m.period < instant)
        left[core[s.task]] = std::max(left[core[s.task]], s.end - instant);
    return left;
  };
  const std::vector<Duration> before = backlog(end - repetition), after = backlog(end);
  for (std::size_t c = 0; c < after.size(); ++c)
    if (before[c] != after[c]) return "core " + std::to_string(c) + " has another backlog one repetition later";
  return "";
}

}  // namespace jarol::analysis
