// What a run measures along a chain is what the analysis says, to the nanosecond.
#include <doctest/doctest.h>

#include "graph/analysis/chains.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;

constexpr std::int64_t ms = 1'000'000;

// When the last task published which activation of the first: (instant, activation).
class Arrivals : public RecordSink {
 public:
  Arrivals(const Graph& graph, std::string last) : outputs_(outputs_of(graph)), last_(std::move(last)) {}
  void take(Duration instant, std::uint32_t output, const void* value) override {
    if (outputs_[output].name != last_) return;
    const auto activation = static_cast<std::int64_t>(*static_cast<const double*>(value));
    if (activation >= 0) seen.emplace_back(instant.count(), activation);
  }
  void finish() override {}
  std::vector<std::pair<std::int64_t, std::int64_t>> seen;

 private:
  std::vector<Output> outputs_;
  std::string last_;
};

struct Measured {
  std::int64_t max_reaction = 0, min_reaction = std::numeric_limits<std::int64_t>::max(), max_age = 0;
};

Measured measure(const std::vector<int>& periods, std::int64_t hyperperiod, analysis::ChainLatency& analysed) {
  std::string tasks, connections;
  std::vector<End> path;
  for (std::size_t i = 0; i < periods.size(); ++i) {
    const std::string p = std::to_string(periods[i]) + "ms", name = "t" + std::to_string(i);
    tasks += "  " + name + ": {type: " + (i == 0 ? "Counter" : "Relay") + ", period: " + p + ", let: " + p +
             ", init: {out: -1}}\n";
    if (i > 0) connections += "  - t" + std::to_string(i - 1) + ".out -> " + name + ".in\n";
    path.push_back({End::Kind::task, i, 0});
  }
  const Graph graph = tests::graph_of("graph: t\ntasks:\n" + tasks + "connections:\n" + connections);
  analysis::Budget budget;
  analysed = analysis::latency_of(graph, path, budget);
  Arrivals arrivals(graph, "t" + std::to_string(periods.size() - 1) + ".out");
  Recorder recorder({&arrivals});
  Executor executor(graph, {}, {.digest = false, .recorder = &recorder});
  executor.run_until(Duration((3 * hyperperiod + 2000) * ms));
  recorder.close();
  // each read shows first when an output rests on it or on a later one; an output is valid until the next
  Measured m;
  const std::int64_t first = periods[0] * ms, start = 1000 * ms, end = start + 2 * hyperperiod * ms;
  std::size_t at = 0;
  for (std::int64_t k = start / first; k * first < end; ++k) {
    while (arrivals.seen[at].second < k) ++at;
    const std::int64_t shown = arrivals.seen[at].first;
    m.min_reaction = std::min(m.min_reaction, shown - k * first);
    m.max_reaction = std::max(m.max_reaction, shown - (k - 1) * first);
  }
  for (std::size_t i = 0; i + 1 < arrivals.seen.size(); ++i)
    if (arrivals.seen[i].first >= start)
      m.max_age = std::max(m.max_age, arrivals.seen[i + 1].first - arrivals.seen[i].second * first);
  return m;
}
}  // namespace

TEST_SUITE("runtime/chains_run") {
  TEST_CASE("executing the published chains measures the analysed maxima") {
    const std::vector<std::pair<std::vector<int>, std::int64_t>> chains{
        {{10, 10, 10, 10}, 10},      {{33, 400, 15, 15, 5}, 13200}, {{10, 15, 15, 5}, 30},
        {{66, 15, 5}, 330},          {{100, 100, 100, 10}, 100},    {{10, 100, 100, 10}, 100},
        {{20, 30, 40, 50, 60}, 600}, {{5, 10, 2, 1, 2}, 10},        {{5, 10, 10, 10}, 10},
        {{10, 20, 20}, 20}};
    for (const auto& chain : chains) {
      const auto& periods = chain.first;
      const std::size_t length = periods.size();
      const int first = periods[0];
      CAPTURE(length);
      CAPTURE(first);
      analysis::ChainLatency analysed;
      const Measured m = measure(periods, chain.second, analysed);
      CHECK(Duration(m.max_reaction) == analysed.max_reaction);
      CHECK(Duration(m.min_reaction) == analysed.min_reaction);
      CHECK(Duration(m.max_age) == analysed.max_age);
    }
  }
}
