#include "graph/analysis/random_graphs.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "graph/values/digest.h"

namespace jarol::analysis {
namespace {

// splitmix64: the same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed * 0x2545f4914f6cdd1dULL) {}
  double unit() { return static_cast<double>(digest::key(seed_ + count_++) >> 11) * 0x1p-53; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(unit() * static_cast<double>(n)); }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

struct Share {
  std::int64_t period_us;
  double share;           // of all tasks, in percent
  double min, mean, max;  // average execution times, us
};

// Kramer, Ziegenbein, Hamann 2015, tables III and IV, without the angle-synchronous row.
constexpr std::array<Share, 9> waters_shares{{{1'000, 3, .34, 5.00, 30.11},
                                              {2'000, 2, .32, 4.20, 40.69},
                                              {5'000, 2, .36, 11.04, 83.38},
                                              {10'000, 25, .21, 10.09, 309.87},
                                              {20'000, 25, .25, 8.74, 291.42},
                                              {50'000, 3, .29, 17.56, 92.98},
                                              {100'000, 20, .21, 10.53, 420.43},
                                              {200'000, 1, .22, 2.56, 21.95},
                                              {1'000'000, 4, .37, .43, .46}}};

struct GeneratedTask {
  std::int64_t period_us;
  double utilisation;
};

std::vector<GeneratedTask> waters(const Generation& g, Random& random) {
  constexpr const auto& rows = waters_shares;
  std::vector<GeneratedTask> tasks;
  double sum = 0, shares = 0;
  for (const Share& row : rows) shares += row.share;
  for (int i = 0; i < g.tasks; ++i) {
    double pick = random.unit() * shares;
    std::size_t r = 0;
    while (r + 1 < rows.size() && pick >= rows[r].share) pick -= rows[r++].share;
    // least, mean and most of the row: a power spreads evenly drawn numbers so that their mean is the row's
    const double exponent = (rows[r].max - rows[r].min) / std::max(1e-9, rows[r].mean - rows[r].min) - 1;
    const double time = rows[r].min + (rows[r].max - rows[r].min) * std::pow(random.unit(), exponent);
    tasks.push_back({rows[r].period_us, time / static_cast<double>(rows[r].period_us)});
    sum += tasks.back().utilisation;
  }
  for (GeneratedTask& t : tasks) t.utilisation *= g.utilisation / sum;
  return tasks;
}

std::vector<GeneratedTask> uunifast(const Generation& g, Random& random) {
  std::vector<GeneratedTask> tasks;
  double left = g.utilisation;
  for (int i = 0; i < g.tasks; ++i) {
    const int after = g.tasks - 1 - i;
    const double next = after == 0 ? 0 : left * std::pow(random.unit(), 1.0 / after);
    const auto period = static_cast<std::int64_t>(std::pow(10.0, 3 + 3 * random.unit()));
    tasks.push_back({period, left - next});
    left = next;
  }
  return tasks;
}

}  // namespace

std::string generate_graph(const Generation& g) {
  Random random(g.seed);
  const std::vector<GeneratedTask> tasks = g.kind == "waters" ? waters(g, random) : uunifast(g, random);
  std::string text = fmt::format(
      "# {} by seed {}: {} tasks, utilisation {}\ngraph: {}_{}\n"
      "platform: {{cores: {}, policy: {}}}\ntasks:\n",
      g.kind, g.seed, g.tasks, g.utilisation, g.kind, g.seed, g.cores, g.policy);
  std::string connections;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const GeneratedTask& t = tasks[i];
    const auto wcet_ns = std::clamp<std::int64_t>(std::llround(t.utilisation * static_cast<double>(t.period_us) * 1e3),
                                                  1, t.period_us * 1000);
    // every third reads one before it; a LET of a period keeps deadlines as long as periods
    const bool reads = i > 0 && i % 3 == 0;
    text += fmt::format("  t{:04}: {{type: {}, period: {}us, let: {}us, wcet: {}ns}}\n", i, reads ? "Relay" : "Counter",
                        t.period_us, t.period_us, wcet_ns);
    if (reads) connections += fmt::format("  - t{:04}.out -> t{:04}.in\n", random.below(i), i);
  }
  return text + (connections.empty() ? "" : "connections:\n" + connections);
}

}  // namespace jarol::analysis
