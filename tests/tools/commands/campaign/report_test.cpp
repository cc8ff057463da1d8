// What a campaign reports of runs that have no value, or are refused.
#include "tools/commands/campaign/campaign_report.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/run_command.h"

namespace {
namespace campaign = jarol::campaign;
namespace tools = jarol::tools;
using campaign::MetricSummary;
using command::TemporaryFolder;

// A metric under a limit, of which so many of ten runs have numbers from 1 to 9.
MetricSummary summary_of(std::uint64_t count) {
  MetricSummary m;
  m.name = "d";
  m.unit = "s";
  m.count = count;
  m.missing = 10 - count;
  if (count == 0) return m;
  m.percentiles = {1, 3, 5, 7, 9};
  m.min = campaign::Case{2, 1};
  m.max = m.worst = campaign::Case{4, 9};
  return m;
}

struct Reported {
  std::string text;
  nlohmann::ordered_json json;
};

Reported reported(const MetricSummary& m, bool all_refused = false) {
  campaign::Campaign measuring;
  measuring.runs = 10;
  measuring.measures.metrics.push_back({"d", true, false});
  measuring.measures.conditions.emplace_back().text = "d < 5 s";
  const campaign::Draws draws(measuring, 0);
  campaign::Summary summary;
  summary.runs = summary.outcomes[0] = 10;
  summary.metrics = {m};
  const tools::CampaignOutcome outcome{.graph = "g",
                                       .campaign = measuring,
                                       .draws = draws,
                                       .summary = summary,
                                       .repeat = [](std::uint64_t i) { return "repeat " + std::to_string(i); },
                                       .results = "r",
                                       .all_refused = all_refused};
  return {to_text(outcome), to_json(outcome)};
}

const std::string title = "g: 10 of 10 runs, 10 good\n",
                  columns = "  metric           min           5 %        median          95 %           max\n",
                  numbers = "  d                1 s           1 s           5 s           9 s           9 s\n";

[[maybe_unused]] const std::string dive =
    " specs/exolauv.yaml --set distributers.dune.link.parameters.dynamics=rigid --set expect=nothing";
}  // namespace

TEST_SUITE("tools/commands/campaign/report") {
  TEST_CASE("a metric that has no value in some runs says of how many its numbers are") {
    CHECK(reported(summary_of(10)).text ==
          title + columns + numbers + "  worst d: 9 s in run 4\n    repeat 4\n  results     r\n");
    const Reported some = reported(summary_of(7));
    CHECK(some.text == title + columns + numbers +
                           "  d       has a value in 7 of 10 runs; these numbers are of those\n"
                           "  worst d: 9 s in run 4\n    repeat 4\n  results     r\n");
    CHECK(!some.json["metrics"][0].contains("bad_without"));
    CHECK(reported(summary_of(0)).text ==
          title + columns + "  d       has no value in any of 10 runs\n  results     r\n");
    MetricSummary words = summary_of(0);
    words.missing = 4;
    words.words = {{"ground", 6}};
    CHECK(reported(words).text == title + columns +
                                      "  d       ground: 6 runs\n  d       has a value in 6 of 10 runs\n"
                                      "  results     r\n");
  }

  TEST_CASE("the first run that is bad as it has no value is named with its command") {
    MetricSummary m = summary_of(7);
    m.bad_without = 3;
    m.first_bad_without = 6;
    const std::string begin = title + columns + numbers +
                              "  d       has a value in 7 of 10 runs; these numbers are of those\n"
                              "  worst value of d: 9 s in run 4\n    repeat 4\n  bad without a value of d: run 6";
    const Reported three = reported(m);
    CHECK(three.text == begin + ", the first of 3 such runs\n    repeat 6\n  results     r\n");
    CHECK(three.json["metrics"][0]["bad_without"] ==
          nlohmann::ordered_json({{"runs", 3}, {"run", 6}, {"command", "repeat 6"}}));
    m.bad_without = 1;
    CHECK(reported(m).text == begin + "\n    repeat 6\n  results     r\n");
    MetricSummary none = summary_of(0);
    none.bad_without = 10;
    none.first_bad_without = 0;
    CHECK(reported(none).text == title + columns +
                                     "  d       has no value in any of 10 runs\n"
                                     "  bad without a value of d: run 0, the first of 10 such runs\n    repeat 0\n"
                                     "  results     r\n");
  }

  TEST_CASE("where all runs that are not good are refused, the report says that there are no mildest values") {
    const Reported refused = reported(summary_of(10), true);
    CHECK(refused.text == title + columns + numbers +
                              "  worst d: 9 s in run 4\n    repeat 4\n"
                              "  no mildest values: all runs that are not good were refused\n  results     r\n");
    CHECK(refused.json["shrunk"].is_null());
    CHECK(!reported(summary_of(10)).json.contains("shrunk"));
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("runs that are refused have no digest, and the mildest run that fails is sought from one that was run") {
    const TemporaryFolder folder;
    const auto dives = [&](const std::string& runs) {
      return command::run_jarol("campaign" + dive +
                                " --for 20s --vary 'tasks.depth.parameters.kp=normal(0.2, 0.3)' --metric "
                                "'deepest=max(depth of dune) < 3.2' --shrink --runs " +
                                runs + " --results " + (folder / runs) + " --csv " + (folder / (runs + ".csv")));
    };
    const std::string why =
        "task 'depth' (DepthControl) parameter 'kp' needs a double [rad/m] from 0 to 10, not '-0.13828408547883264'; "
        "that is outside";
    const command::Result twelve = dives("12");
    CHECK(twelve.exit_code == 1);
    CHECK(command::content(folder / "12.csv").find("\n2,0,-0.13828408547883264,,refused,0,0,,\"" + why + "\",0\n") !=
          std::string::npos);
    CAPTURE(twelve.output);
    CHECK(twelve.output.find(" of 12 runs, 7 good, 2 bad, 3 refused;") != std::string::npos);
    CHECK(twelve.output.ends_with(
        "  mildest values with which run 3 still fails, by 13 more runs: metric 'deepest' is beyond its limit: it "
        "reached 3.2001 m\n"
        "    jarol run" +
        dive + " --set tasks.depth.parameters.kp=0.7824415042641448 --seed 0 --for 20s --record run_3_mild.mcap\n" +
        "  results     " + (folder / "12") + "\n"));
    const command::Result three = dives("3");
    CHECK(three.exit_code == 1);
    CHECK(three.output.ends_with(
        "  run 2 is refused: " + why + "\n    jarol run" + dive +
        " --set tasks.depth.parameters.kp=-0.13828408547883264 --seed 0 --for 20s --record run_2.mcap\n"
        "  no mildest values: all runs that are not good were refused\n  results     " +
        (folder / "3") + "\n"));
  }

  TEST_CASE("a report says where all runs are the same, and of which good runs not all that is expected was judged") {
    const TemporaryFolder folder;
    const std::string of =
        "campaign specs/exolauv.yaml --set distributers.dune.link.parameters.dynamics=rigid --vary seed=1..3 --for 3s "
        "--results " +
        (folder / "r");
    REQUIRE(command::run_jarol(of).exit_code == 0);
    const std::string why = "5 conditions were not judged: the run ended at 3 s, its mission ends at 100 s";
    CHECK(command::run_jarol(of).output ==
          "exolauv: 3 of 3 runs, 3 good\n"
          "  all 3 runs have one digest: what varies has no effect\n"
          "  run 0 is good as far as it was judged, the first of 3 such runs: " +
              why + "\n  results     " + (folder / "r") + "\n");
    const auto json = nlohmann::json::parse(command::run_jarol(of + " --json").output);
    CHECK(json["all_same"] == true);
    CHECK(json["not_judged"] == nlohmann::json{{"runs", 3}, {"run", 0}, {"why", why}});
  }

  TEST_CASE("a dive that never settles is bad, and its command stands beside that of the slowest that does") {
    const TemporaryFolder folder;
    const command::Result result =
        command::run_jarol("campaign" + dive +
                           " --for 30s --vary 'tasks.depth.parameters.kp=[0.5, 0.05, 0.06]' --metric "
                           "'d=settling_time(depth of dune to 3 within 0.1) < 20 s' --results " +
                           (folder / "r"));
    CHECK(result.exit_code == 1);
    const auto repeated = [](const std::string& kp, const std::string& run) {
      return "    jarol run" + dive + " --set tasks.depth.parameters.kp=" + kp + " --seed 0 --for 30s --record run_" +
             run + ".mcap\n";
    };
    CHECK(result.output.substr(result.output.find('\n') + 1) ==
          "  metric           min           5 %        median          95 %           max\n"
          "  d            12.97 s       12.97 s       12.97 s       12.97 s       12.97 s\n"
          "  d       has a value in 1 of 3 runs; these numbers are of those\n"
          "  worst value of d: 12.97 s in run 0\n" +
              repeated("0.5", "0") + "  bad without a value of d: run 1, the first of 2 such runs\n" +
              repeated("0.05", "1") + "  run 1 is bad: metric 'd' is beyond its limit: it had not settled\n" +
              repeated("0.05", "1") + "  run 2 is bad: metric 'd' is beyond its limit: it had not settled\n" +
              repeated("0.06", "2") + "  results     " + (folder / "r") + "\n");
  }
#endif
}
