// Runs of a campaign in which a task does not come back.
#include "distributers/campaign/oversight.h"

#include <doctest/doctest.h>

#include <thread>

#include "distributers/campaign/run_all.h"
#include "graph/campaign/draws.h"
#include "tests/distributers/all_parts.h"

namespace {
using namespace jarol;
using namespace jarol::campaign;
using namespace std::chrono_literals;

std::atomic<bool> freed{false};
std::atomic<int> waiting_runs{0};

struct Waits {
  static constexpr std::string_view summary = "does not come back from one of its activations before it is freed";
  struct Param {
    std::int64_t at = -1;
    static constexpr auto fields() { return describe(field<&Param::at>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick& tick, Out& out) {
    if (tick.activation == p.at) ++waiting_runs;
    while (tick.activation == p.at && !freed) std::this_thread::sleep_for(1ms);
    out.out = static_cast<double>(tick.activation);
  }
};

const char* const waiting =
    "graph: t\n"
    "timing: {period: 10ms}\n"
    "tasks: {a: {type: Waits}, b: {type: Waits}}\n"
    "campaign: {for: 1s, metrics: {last: final(b.out)}}\n";
}  // namespace

TEST_SUITE("distributers/campaign/oversight") {
  TEST_CASE("a task that does not come back is named once, with its run, whatever other runs do beside it") {
    const GraphSource source{
        std::make_shared<const Source>(Source{"t.yaml", waiting}), tests::all_parts_with<Waits>(), {}, {}};
    Graphs graphs(source);
    const Campaign campaign = state_campaign(graphs, {.vary = {"tasks.b.parameters.at=[-1, -1, 7, -1]"}});
    const Draws draws(campaign, 0);
    Results results(":memory:", {{"graph", "t"}}, campaign);
    std::vector<std::string> told;
    freed = false;
    StuckRuns stuck(
        [&](std::uint64_t run, const HangingTask& task) {
          told.push_back("run " + std::to_string(run) + ": " + to_text(task));
          if (told.size() > 1) freed = true;  // were it told twice
        },
        {}, 100ms);
    std::thread later([] {
      std::this_thread::sleep_for(600ms);
      freed = true;
    });
    const std::atomic<bool> stop{false};
    run_all(graphs, campaign, draws, missing(results.done(draws.runs()), Shard{}.of(draws.runs())), 2, results,
            [](const Result&) {}, {stop, &stuck});
    later.join();
    CHECK(told == std::vector<std::string>{"run 2: task 'b' activation 7 at 0.07 s has not ended"});
    std::vector<double> last;
    results.for_each([&](const Result& result) { last.push_back(result.metrics[0].number.value_or(-1)); });
    CHECK(last == std::vector<double>{99, 99, 99, 99});
  }

  TEST_CASE("runs that go on once the campaign is to stop are counted and reported once") {
    const GraphSource source{
        std::make_shared<const Source>(Source{"t.yaml", waiting}), tests::all_parts_with<Waits>(), {}, {}};
    Graphs graphs(source);
    const Campaign campaign = state_campaign(graphs, {.vary = {"tasks.b.parameters.at=[7, 7]"}});
    const Draws draws(campaign, 0);
    Results results(":memory:", {{"graph", "t"}}, campaign);
    freed = false;
    std::atomic<bool> stop{false};
    std::vector<std::size_t> told;
    StuckRuns stuck([](std::uint64_t, const HangingTask&) {},
                    WaitNote{[&](std::size_t runs) {
                               told.push_back(stop ? runs : 0);
                               freed = true;
                             },
                             stop, 30ms},
                    40ms);
    waiting_runs = 0;
    std::thread later([&] {
      while (waiting_runs < 2) std::this_thread::sleep_for(1ms);
      stop = true;
    });
    run_all(graphs, campaign, draws, missing(results.done(draws.runs()), Shard{}.of(draws.runs())), 2, results,
            [](const Result&) {}, {stop, &stuck});
    later.join();
    CHECK(told == std::vector<std::size_t>{2});
  }
}
