#include "graph/analysis/global_edf.h"

#include <algorithm>

namespace jarol::analysis {
namespace {

// Most that a task executes in any window: carried in as late as its slack allows (Bertogna, Cirinei 2007, eq. 4).
Duration workload(const TaskModel& task, Duration slack, Duration window) {
  const Duration reach = window + task.deadline - task.wcet - slack;
  const std::int64_t whole = reach / task.period;
  return whole * task.wcet + std::min(task.wcet, reach - whole * task.period);
}

// The same for a window that ends with a deadline that EDF puts before: aligned at deadlines (eq. 6).
Duration before_deadline(const TaskModel& task, Duration slack, Duration deadline) {
  const std::int64_t whole = deadline / task.period;
  return whole * task.wcet + std::min(task.wcet, std::max(Duration{}, deadline - whole * task.period - slack));
}

}  // namespace

bool passes_gfb(std::span<const TaskModel> models, std::int64_t cores) {
  long double sum = 0, largest = 0;
  for (const TaskModel& task : models) {
    if (std::min(task.deadline, task.period) <= task.jitter) return false;
    const long double density = static_cast<long double>(task.wcet.count()) /
                                static_cast<long double>((std::min(task.deadline, task.period) - task.jitter).count());
    sum += density;
    largest = std::max(largest, density);
  }
  const auto m = static_cast<long double>(cores);
  return largest <= 1 && sum * (1 + 1e-15L) <= m - (m - 1) * largest;
}

std::vector<std::optional<Duration>> global_edf_responses(std::span<const TaskModel> models, std::int64_t cores,
                                                          Budget& budget) {
  constexpr int max_rounds = 100, plain_steps = 100;
  std::vector<std::optional<Duration>> responses(models.size());
  for (const TaskModel& task : models)
    if (task.wcet > task.deadline - task.jitter) return responses;
  std::vector<Duration> slack(models.size());
  bool changed = true;
  for (int round = 0; changed && round < max_rounds; ++round) {
    changed = false;
    for (std::size_t k = 0; k < models.size(); ++k) {
      const TaskModel& own = models[k];
      // from the release on
      const Duration max = own.deadline - own.jitter;
      Duration response = own.wcet;
      for (int step = 0; response <= max; ++step) {
        if (!budget.spend(2 * models.size())) return responses;
        Wide sum = 0;
        for (std::size_t i = 0; i < models.size(); ++i)
          if (i != k)
            sum += std::min({workload(models[i], slack[i], response),
                             before_deadline(models[i], slack[i], own.deadline), response - own.wcet + Duration(1)})
                       .count();
        const Duration next = own.wcet + Duration(static_cast<std::int64_t>(sum / cores));
        const bool bounded = next <= response;
        response = next;
        if (bounded) break;
        // what maps to no more than itself is a bound too: leaps find one where steps would be of a nanosecond
        if (step >= plain_steps && next < max) response = std::min(max, next + (next - own.wcet) / 16);
      }
      if (response > max) continue;
      response += own.jitter;
      responses[k] = response;
      if (own.deadline - response > slack[k]) {
        slack[k] = own.deadline - response;
        changed = true;
      }
    }
    // more rounds would tighten bounds that hold already
    if (std::all_of(responses.begin(), responses.end(), [](const auto& r) { return r.has_value(); })) break;
  }
  return responses;
}

}  // namespace jarol::analysis
