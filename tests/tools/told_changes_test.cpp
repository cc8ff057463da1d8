// What a run's report tells of a vehicle's own decisions.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/tools/run_command.h"

namespace {
using command::jarol;

std::vector<std::string> told_in(const std::string& report) {
  std::vector<std::string> lines;
  const std::string begin = "  told        ";
  for (std::size_t at = 0; (at = report.find(begin, at)) != std::string::npos;) {
    at += begin.size();
    lines.push_back(report.substr(at, report.find('\n', at) - at));
  }
  return lines;
}

const std::string sonar = " --set distributers.robostix.link.parameters.failures.sonar.";
const std::string leak = " --set 'distributers.dune.link.parameters={leak_at: 500ms}'";
}  // namespace

TEST_SUITE("tools/told_changes") {
  TEST_CASE("of a flight or a dive without an event nothing is told") {
    CHECK(told_in(jarol("run specs/javiator.yaml").output).empty());
    CHECK(told_in(jarol("run specs/exolauv.yaml").output).empty());
    CHECK(nlohmann::json::parse(jarol("run specs/exolauv.yaml --for 2s --json").output)["told"] ==
          nlohmann::json::array());
  }

  TEST_CASE("a landing that nobody wanted is told with its instant and its cause, and how it ended") {
    const std::string run = "run specs/javiator.yaml" + sonar + "kind=lost" + sonar + "at=12s";
    CHECK(told_in(jarol(run).output) ==
          std::vector<std::string>{
              "to_terminal at 12.28 s: state landing, cause sonar_lost: the sonar tells nothing credible",
              "to_terminal at 18.34 s: state ground",
              // its operator has it start once more
              "to_terminal at 28.03 s: state starting, cause none",
              "to_terminal at 28.045 s: state ground, cause sonar_lost: the sonar tells nothing credible"});
    CHECK(nlohmann::json::parse(jarol(run + " --json").output)["told"][0] ==
          nlohmann::json{{"communicator", "to_terminal"},
                         {"instant_ns", 12'280'000'000},
                         {"values", {{"state", "landing"}, {"cause", "sonar_lost"}}},
                         {"meanings", {"the sonar tells nothing credible"}}});
  }

  TEST_CASE("water in the hull is told, on any clock and by threads too") {
    const std::string line = "alarm leak: it comes up, as there is water in the hull, or the leak detector is silent";
    const std::string run = "run specs/exolauv.yaml --for 2s" + leak;
    CHECK(told_in(jarol(run).output) == std::vector<std::string>{"to_neptus at 1.02 s: " + line});
    for (const std::string concurrency : {"exotasks", "threads"}) {
      const auto told = told_in(jarol(run + " --clock real --concurrency " + concurrency).output);
      REQUIRE(told.size() == 1);
      CHECK(told[0].ends_with(" s: " + line));
    }
  }

  TEST_CASE("an alarm that is over is told, too") {
    const auto told = told_in(jarol("run specs/exolauv.yaml --for 110s --set "
                                    "distributers.neptus.link.file=../tests/data/lauv-recovered.csv")
                                  .output);
    CHECK(told == std::vector<std::string>{"to_neptus at 36.02 s: alarm operator_lost: it comes up, as the operator is silent",
                                           "to_neptus at 70.02 s: alarm none"});
  }
}
