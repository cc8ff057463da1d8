// A mission that failed does not exit 0, and one that went well does.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "graph/language/yaml.h"
#include "tests/tools/run_command.h"

namespace {
using command::Result;
using command::TemporaryFolder;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// The shipped graph without what it expects: its vehicle alone is judged.
Result run_without_expect(const std::string& spec, const std::string& options) {
  return command::run_jarol("run specs/" + spec + ".yaml --set expect=nothing " + options);
}

// The hover, with the motors stopped by its pilot at 10 s.
std::string mission_that_stops(const TemporaryFolder& folder) {
  return folder.write("cut.csv",
                      "time,command.altitude,command.mode_switches,command.state_switches,command.shut_downs\n"
                      "0,0,1,0,0\n0.5,0,1,1,0\n1,0,1,2,0\n4,1,1,2,0\n10,1,1,2,1\n14,1,1,2,1\n");
}
}  // namespace

TEST_SUITE("tools/verdicts") {
  TEST_CASE("every shipped mission holds what it expects, in every profile that needs nobody else") {
    for (const std::string run :
         {"exolauv", "exolauv --profile at_sea --seed 1", "exolauv --profile submarine_dune",
          "exolauv --profile submarine_vsim", "exolauv_bare", "javiator", "javiator --profile wind",
          "javiator --profile wind --seed 3", "javiator --profile radio", "javiator --profile radio --seed 3",
          "javiator --profile v2", "javiator --profile original"}) {
      CAPTURE(run);
      const std::size_t space = run.find(' ');
      const Result result = command::run_jarol("run specs/" + run.substr(0, space) + ".yaml" +
                                               (space == std::string::npos ? "" : run.substr(space)));
      CHECK(result.exit_code == 0);
      CHECK(contains(result.output, ": holds"));
      CHECK(!contains(result.output, "not judged"));
      CHECK(!contains(result.output, "error"));
    }
  }

  TEST_CASE("a wrong gain, and a sensor that brings it down early, end with 1 and a line for each condition") {
    const Result gain = command::run_jarol("run specs/exolauv.yaml --set tasks.depth.parameters.kp=0.02");
    CHECK(gain.exit_code == 1);
    CHECK(contains(gain.output, "error: expected 'depth of dune within 0.05 of 3', but it reached 1.9"));
    const std::string sonar = " --set distributers.robostix.link.parameters.failures.sonar.";
    const Result early = command::run_jarol("run specs/javiator.yaml" + sonar + "kind=lost" + sonar + "at=12s");
    CHECK(early.exit_code == 1);
    CHECK(contains(early.output, "error: expected 'never logic.directive.cause is not none', but it was so at 12.2"));
    const Result alarm = command::run_jarol(
        "run specs/exolauv.yaml --set "
        "'distributers.dune.link.parameters={sensors: {depth: {failure: {kind: lost, at: 30 s}}}}'");
    CHECK(alarm.exit_code == 1);
    CHECK(contains(alarm.output, "expected    never supervisor.condition.alarm is not none: FAILS: "));
  }

  TEST_CASE(
      "a campaign that ends before its mission measures its runs as long as they are; integers are measured, too") {
    const TemporaryFolder folder;
    const Result campaign = command::run_jarol(
        "campaign specs/exolauv.yaml --for 12s --runs 2 --vary seed=1..2 --set expect=nothing --set "
        "distributers.dune.link.parameters.dynamics=rigid --metric 'deep=depth of dune < 1' --metric "
        "'mean=mean(depth of dune) before 8s' --metric 'count=max(from_dune.depth.count)' --csv - --results " +
            (folder / "r"),
        "2>/dev/null");
    CHECK(campaign.exit_code == 1);
    CHECK(contains(campaign.output, ",bad,0,12,"));
    CHECK(!contains(campaign.output, ",,"));
  }

  TEST_CASE("motors that are stopped at 1 m end with a crash, by the true state") {
    const TemporaryFolder folder;
    const Result result =
        run_without_expect("javiator", "--set distributers.terminal.link.file=" + mission_that_stops(folder));
    CHECK(result.exit_code == 1);
    CHECK(contains(result.output,
                   "error: the vehicle of 'robostix' has crashed: a foot met the ground at 4.3 m/s, above "
                   "2 m/s, at 10.52 s\n"));
  }

  TEST_CASE("a helicopter on its back ends with 1") {
    const Result result = run_without_expect("javiator", "--set tasks.attitude.parameters.lean.effect=-66");
    CHECK(result.exit_code == 1);
    CHECK(contains(result.output, "error: the vehicle of 'robostix' has crashed: a rotor met the ground, at "));
  }

  TEST_CASE("a helicopter that is too heavy has never taken off") {
    const Result result =
        run_without_expect("javiator", "--set 'distributers.robostix.link.parameters={frame: {mass: 6}}'");
    CHECK(result.exit_code == 1);
    CHECK(contains(result.output,
                   "error: the vehicle of 'robostix' has never taken off: its rotors were at 8000 or "
                   "more of 16000 for "));
  }

  TEST_CASE("a submarine that sinks below its limit, to the floor, or turns over ends with 1") {
    const auto sinks = [](const std::string& parameters) {
      return run_without_expect("exolauv", "--set 'distributers.dune.link.parameters={" + parameters + "}'");
    };
    // without the altimeter's range it does not drive up in time
    const Result deep = sinks("hull: {buoyancy: 170 N}, sea: {floor: 200}, limits: {depth: 15}");
    CHECK(deep.exit_code == 1);
    CHECK(contains(deep.output, "error: the vehicle of 'dune' has sunk: 15.0 m deep, beyond 15 m, at "));
    const Result floor = sinks("hull: {buoyancy: 150 N}, sea: {floor: 5}");
    CHECK(floor.exit_code == 1);
    CHECK(contains(floor.output, "error: the vehicle of 'dune' has sunk: it touched the sea floor, 5 m deep, at "));
    const Result over = sinks("hull: {z_g: -0.01 m}");
    CHECK(over.exit_code == 1);
    CHECK(contains(over.output, "error: the vehicle of 'dune' has capsized: tilted by "));
  }

  TEST_CASE("a run that is cut short is not judged by what was still to come") {
    const Result result = command::run_jarol("run specs/exolauv.yaml --for 10s");
    CHECK(result.exit_code == 0);
    CHECK(contains(result.output,
                   "  expected    5 conditions: not judged: the run ended at 10 s, its mission ends at 100 s\n"));
  }

  TEST_CASE("a verdict as JSON has each condition, the true values and the mishaps, and the exit code is the same") {
    const TemporaryFolder folder;
    const Result result = command::run_jarol(
        "run specs/javiator.yaml --json --set 'expect=[height of robostix < 1cm, once y of "
        "robostix > 2]' --set distributers.terminal.link.file=" +
            mission_that_stops(folder),
        "2>/dev/null");
    CHECK(result.exit_code == 1);
    const auto json = nlohmann::json::parse(result.output);
    CHECK(std::abs(json["true_values"]["robostix"]["height"].get<double>()) < 0.002);  // its feet give by 1.5 mm
    const auto& judged = json["judgement"];
    CHECK(judged["negative"] == true);
    CHECK(judged["expectations"][0]["verdict"] == "holds");
    CHECK(judged["expectations"][0]["unit"] == "m");
    CHECK(judged["expectations"][1] ==
          nlohmann::json::parse(R"({"condition": "once y of robostix > 2", "verdict": "fails", "why": "was not so"})"));
    CHECK(judged["mishaps"][0]["distributer"] == "robostix");
    CHECK(judged["left_out"].empty());
  }

  TEST_CASE("a replay judges what was published as the run did, and says that it has no vehicle") {
    const TemporaryFolder folder;
    int number = 0;
    for (const std::string expect :
         {"speed of dune < 3, to_neptus.depth within 0.05 of 3, max(navigation.motion.z) > 3",
          "speed of dune < 3, to_neptus.depth within 0.05 of 4"}) {
      CAPTURE(expect);
      const std::string log = folder / ("run" + std::to_string(++number) + ".log");
      const std::string set = " --set 'expect=[" + expect + "]'";
      const Result run = command::run_jarol("run specs/exolauv.yaml --log " + log + set);
      const Result again = command::run_jarol("replay " + log);
      CHECK(again.exit_code == run.exit_code);
      CHECK(contains(again.output,
                     "  expected    5 conditions: not judged: the vehicle of 'dune' is not simulated "
                     "in this process\n"));
      const std::size_t published = run.output.find("  expected    to_neptus");
      REQUIRE(published != std::string::npos);
      const std::string line = run.output.substr(published, run.output.find('\n', published) - published);
      CHECK(contains(again.output, line));
    }
  }
}
