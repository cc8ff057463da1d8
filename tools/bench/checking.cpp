#include "tools/bench/checking.h"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>
#include <vector>

#include "graph/analysis/check.h"
#include "tools/bench/graphs.h"
#include "tools/bench/timing.h"

namespace jarol::bench {
namespace {

std::string graph_text(const std::string& platform, int tasks, const std::function<std::int64_t(int)>& period_us,
                       const std::function<std::int64_t(std::int64_t)>& wcet_ns) {
  std::string text = "graph: large\nplatform: " + platform + "\ntasks:\n";
  for (int i = 0; i < tasks; ++i) {
    const std::int64_t period = period_us(i);
    text += "  t" + std::to_string(100'000 + i) + ": {type: Work, period: " + std::to_string(period) +
            "us, wcet: " + std::to_string(std::max<std::int64_t>(1, wcet_ns(period))) + "ns}\n";
  }
  return text;
}

// Periods and their shares as in WATERS 2015 (Kramer, Ziegenbein, Hamann).
std::int64_t automotive(int i) {
  constexpr std::array<int, 20> periods{1,  2,  5,  10, 10,  10,  10,  10,  20,  20,
                                        20, 20, 20, 50, 100, 100, 100, 100, 200, 1000};
  return 1000 * periods[static_cast<std::size_t>(i) % periods.size()];
}

// No two alike, and without a common multiple within reach.
std::int64_t coprime(int i) { return 9001 + 10 * i; }

double check_ms(const Graph& graph) {
  return 1e3 * seconds_of([&] { keep(static_cast<double>(analysis::check(graph).response.size())); });
}

}  // namespace

Figure measure_check(const std::string& name, int tasks, double goal, int repeats) {
  Figure worst{name, 0, "ms", 1, 0, goal, ""};
  // the goal is absolute: the floor is its unit, one millisecond
  const auto share = [=](std::int64_t period) { return 600 * period / tasks; };  // 60 % of the core in all
  // the table takes all in one go at 0: so short that the quickest still end in time
  const auto short_ones = [=](std::int64_t) { return std::int64_t{900'000} / tasks; };
  const std::vector<std::pair<std::string, std::string>> sets{
      {"table", graph_text("{policy: table}", tasks, automotive, short_ones)},
      {"fixed priorities", graph_text("{policy: fixed_priority}", tasks, automotive, share)},
      {"edf", graph_text("{policy: edf}", tasks, automotive, share)},
      {"fixed priorities, periods all different",
       graph_text("{policy: fixed_priority, phasing: any}", tasks, coprime, share)},
      {"edf, periods all different", graph_text("{policy: edf, phasing: any}", tasks, coprime, share)}};
  for (const auto& [what, text] : sets) {
    const Graph graph = graph_of(text);
    if (analysis::check(graph).verdict != analysis::Verdict::schedulable) throw std::logic_error(what + " must hold");
    double min = 1e300;
    for (int i = 0; i < std::max(3, repeats / 10); ++i) min = std::min(min, check_ms(graph));
    if (min < worst.value) continue;
    worst.value = worst.ratio = min;
    worst.text =
        "check of " + std::to_string(tasks) + " tasks beyond loading / 1 ms, the slowest of five sets: " + what;
  }
  return worst;
}

}  // namespace jarol::bench
