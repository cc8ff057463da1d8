// The mildest run that still fails.
#include "tests/distributers/campaign/waves.h"

#include <doctest/doctest.h>

#include "distributers/campaign/shrink.h"

namespace {
using namespace jarol;
using namespace jarol::campaign;
using namespace jarol::campaign::trial;
using namespace std::chrono_literals;
}  // namespace

TEST_SUITE("distributers/campaign/shrink") {
  TEST_CASE("the mildest run that still fails is found: what need not be away from the middle is there") {
    const Folder folder;
    // a breaks the limit alone; b stands beside it, and seeds change nothing
    Under under(
        source_of(waves, {"high=max(a.out) < 2.5"}),
        {.vary = {"tasks.b.parameters.gain=-0.5..0.5", "seed=3..4", "tasks.a.parameters.gain=-1..4"}, .runs = 9}, 5,
        folder / "r");
    under.run(2);
    const std::vector<Result> all = under.all();
    const auto first =
        std::find_if(all.begin(), all.end(), [](const Result& r) { return r.outcome == campaign::Outcome::bad; });
    REQUIRE(first != all.end());
    const auto shrunk =
        shrink(under.graphs, under.campaign, under.draws, first->index, campaign::Outcome::bad, under.stop);
    REQUIRE(shrunk.has_value());
    CHECK(shrunk->start.set[0] == "tasks.b.parameters.gain=0");
    CHECK(shrunk->start.index == first->index);
    CHECK(shrunk->result.outcome == campaign::Outcome::bad);
    CHECK(!shrunk->at_the_middle);
    CHECK(shrunk->tried == 14);
    const auto ends = [&](double gain) {
      Start start = shrunk->start;
      start.set[1] = "tasks.a.parameters.gain=" + std::to_string(gain);
      return run_one(under.graphs, start, under.campaign.length, under.stop)->outcome;
    };
    const double gain = std::stod(shrunk->start.values[2]);
    CHECK(ends(gain) == campaign::Outcome::bad);
    CHECK(ends(gain - (std::stod(under.draws.at(first->index).values[2]) - 1.5) / 1000) == campaign::Outcome::good);
    // where the middle of all fails too, that is the mildest
    Under worse(source_of(waves, {"high=max(a.out) < 0.1"}), {.vary = {"tasks.a.parameters.gain=1..4"}, .runs = 2}, 5,
                folder / "worse");
    worse.run(1);
    const auto middle = shrink(worse.graphs, worse.campaign, worse.draws, 1, campaign::Outcome::bad, worse.stop);
    REQUIRE(middle.has_value());
    CHECK(middle->at_the_middle);
    CHECK(middle->start.set[0] == "tasks.a.parameters.gain=2.5");
    worse.stop = true;
    CHECK(!shrink(worse.graphs, worse.campaign, worse.draws, 1, campaign::Outcome::bad, worse.stop));
  }

  TEST_CASE("the mildest run fails as the one that is made milder: by its metric, condition, or task and cause") {
    const Folder folder;
    const auto mildest = [&](const std::string& name, const std::vector<std::string>& vary,
                             const std::vector<std::string>& metrics, std::uint64_t index) {
      Under under(source_of(waves, metrics), {.vary = vary}, 0, folder / name);
      const std::optional<Result> first =
          run_one(under.graphs, under.draws.at(index), under.campaign.length, under.stop);
      REQUIRE(first.has_value());
      const auto shrunk = shrink(under.graphs, under.campaign, under.draws, index, first->outcome, under.stop);
      REQUIRE(shrunk.has_value());
      return shrunk->start.set[0].substr(std::string("tasks.a.parameters.").size()) + ": " + shrunk->result.why;
    };
    // of the list the second breaks the other limit
    CHECK(mildest("metric", {"tasks.a.parameters.gain=[1, 0.1, 1.7]"},
                  {"high=max(a.out) < 1.5", "low=max(a.out) > 0.5"},
                  2) == "gain=1.7: metric 'high' is beyond its limit: it reached 1.7");
    // what comes first in a milder run is not all that is against it
    CHECK(mildest("both", {"tasks.a.parameters.gain=[1, 1.6, 1.7]"}, {"low=max(a.out) < 1.65", "high=min(b.out) < -1"},
                  1) == "gain=1: metric 'high' is beyond its limit: it reached -0.5");
    CHECK(mildest("fault",
                  {"tasks.a.parameters.fails_at=[-1, 20]", "tasks.a.parameters.stops_being_finite_at=[-1, 50]"}, {},
                  3) == "fails_at=20: task 'a' activation 20 at 0.2 s: threw: it was to fail");
  }
}
