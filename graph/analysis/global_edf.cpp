#include "graph/analysis/global_edf.h"

#include <algorithm>

namespace jarol::analysis {
namespace {

// Most that a task executes in any window: carried in as late as its slack allows (Bertogna, Cirinei 2007, eq. 4).
std::int64_t workload(const Load& l, std::int64_t slack, std::int64_t window) {
  const std::int64_t reach = window + l.deadline - l.wcet - slack;
  const std::int64_t whole = reach / l.period;
  return whole * l.wcet + std::min(l.wcet, reach - whole * l.period);
}

// The same for a window that ends with a deadline that EDF puts before: aligned at deadlines (eq. 6).
std::int64_t before_deadline(const Load& l, std::int64_t slack, std::int64_t deadline) {
  const std::int64_t whole = deadline / l.period;
  return whole * l.wcet + std::min(l.wcet, std::max<std::int64_t>(0, deadline - whole * l.period - slack));
}

}  // namespace

bool passes_gfb(std::span<const Load> loads, std::int64_t cores) {
  long double sum = 0, largest = 0;
  for (const Load& l : loads) {
    if (std::min(l.deadline, l.period) <= l.jitter) return false;
    const long double density =
        static_cast<long double>(l.wcet) / static_cast<long double>(std::min(l.deadline, l.period) - l.jitter);
    sum += density;
    largest = std::max(largest, density);
  }
  const auto m = static_cast<long double>(cores);
  return largest <= 1 && sum * (1 + 1e-15L) <= m - (m - 1) * largest;
}

std::vector<std::optional<std::int64_t>> global_edf_responses(std::span<const Load> loads, std::int64_t cores) {
  constexpr int most_rounds = 100, plain_steps = 100;
  std::vector<std::optional<std::int64_t>> responses(loads.size());
  for (const Load& l : loads)
    if (l.wcet > l.deadline - l.jitter) return responses;
  std::vector<std::int64_t> slack(loads.size(), 0);
  bool changed = true;
  for (int round = 0; changed && round < most_rounds; ++round) {
    changed = false;
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const Load& own = loads[k];
      // from the release on
      const std::int64_t most = own.deadline - own.jitter;
      std::int64_t response = own.wcet;
      for (int step = 0; response <= most; ++step) {
        Wide sum = 0;
        for (std::size_t i = 0; i < loads.size(); ++i)
          if (i != k)
            sum += std::min({workload(loads[i], slack[i], response), before_deadline(loads[i], slack[i], own.deadline),
                             response - own.wcet + 1});
        const std::int64_t next = own.wcet + static_cast<std::int64_t>(sum / cores);
        const bool bounded = next <= response;
        response = next;
        if (bounded) break;
        // what maps to no more than itself is a bound too: leaps find one where steps would be of a nanosecond
        if (step >= plain_steps && next < most) response = std::min(most, next + (next - own.wcet) / 16);
      }
      if (response > most) continue;
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
