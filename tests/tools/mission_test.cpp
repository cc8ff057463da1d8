// What a mission says that it is to reach: judged as what its graph expects is, wherever that is judged.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/how_many.h"
#include "tests/tools/run_command.h"

namespace {
using command::run_jarol;
using command::TemporaryFolder;
namespace tests = jarol::tests;

const std::string titles = "time,setpoint.depth,setpoint.heading,setpoint.speed\n";

std::string dive_by(const TemporaryFolder& folder, const std::string& expected) {
  return "specs/exolauv.yaml --set distributers.neptus.link.file=" +
         folder.write("mission.csv", expected + titles + "0,0,0deg,0\n1,2,0deg,1\n3,2,0deg,1\n");
}

std::string expected_lines(const std::string& output) {
  std::string lines;
  std::istringstream in(output);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("  expected ")) lines += line + "\n";
  return lines;
}
}  // namespace

TEST_SUITE("tools/mission") {
  TEST_CASE("every shipped mission that expects something reaches it, in the graph that it is for") {
    const std::string dive =
                          "specs/exolauv.yaml --set distributers.dune.link.parameters.dynamics=rigid "
                          "--set distributers.neptus.link.file=missions/",
                      flight =
                          "specs/javiator.yaml --set distributers.robostix.link.parameters.dynamics=rigid "
                          "--set distributers.terminal.link.file=missions/";
    const std::map<std::string, std::string> runs{{"deep.csv", dive + "deep.csv"},
                                                  {"dive.csv", dive + "dive.csv"},
                                                  {"late.csv", dive + "late.csv"},
                                                  {"hover.csv", flight + "hover.csv"},
                                                  {"recorded.csv", flight + "recorded.csv --profile original"}};
    std::set<std::string> expecting;
    for (const auto& mission : std::filesystem::directory_iterator("specs/missions")) {
      const std::string name = mission.path().filename();
      CAPTURE(name);
      std::vector<std::string> expected;
      std::istringstream in(command::content(mission.path()));
      for (std::string line; std::getline(in, line);)
        if (line.starts_with("expect: ")) expected.push_back(line.substr(8, line.find("  #") - 8));
      if (expected.empty()) continue;
      REQUIRE(runs.contains(name));
      expecting.insert(name);
      if (tests::tries_less && name != "hover.csv" && name != "late.csv") continue;
      const auto run = run_jarol("run " + runs.at(name), "2>&1");
      CHECK(run.exit_code == 0);
      const std::string lines = expected_lines(run.output);
      CAPTURE(lines);
      for (const std::string& condition : expected)
        CHECK(lines.find("  expected    " + condition + ": holds") != std::string::npos);
    }
    for (const auto& [name, arguments] : runs) {
      CAPTURE(name);
      CHECK(expecting.contains(name));
    }
  }

  TEST_CASE("a run is judged by its mission first, then by its graph, and a dive that is too short fails") {
    const TemporaryFolder folder;
    const std::string command = "run " + dive_by(folder,
                                                 "expect: depth of dune > 1.9  # it is on its way\n"
                                                 "expect: never depth of dune > 3\n");
    const auto run = run_jarol(command, "2>&1");
    CHECK(run.exit_code == 1);
    const std::string lines = expected_lines(run.output);
    CAPTURE(lines);
    CHECK(lines.starts_with("  expected    depth of dune > 1.9: FAILS: reached "));
    CHECK(
        lines.ends_with(" m\n  expected    never depth of dune > 3: holds\n"
                        "  expected    never supervisor.condition.alarm is not none: holds\n"));
    CHECK(run.output.find("error: expected 'depth of dune > 1.9', but it ") != std::string::npos);
    const auto none = run_jarol(command + " --set expect=nothing", "2>&1");
    CHECK(none.exit_code == 0);
    CHECK(expected_lines(none.output) == "");
  }

  TEST_CASE("check finds what is wrong in a condition, at its place in the mission") {
    const TemporaryFolder folder;
    const std::string command = dive_by(folder, "expect: depht of dune > 1.9\n");
    const auto check = run_jarol("check " + command, "2>&1");
    CHECK(check.exit_code == 2);
    CHECK(check.output.find(folder / "mission.csv" + ":1:9: error: ") != std::string::npos);
    CHECK(check.output.find("\n  expect: depht of dune > 1.9\n          ^\n") != std::string::npos);
  }

  TEST_CASE("a replay judges by the mission that was recorded, whatever its file says now") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.mcap";
    const std::string command = dive_by(folder, "expect: depth of dune > 1.9\n");
    REQUIRE(run_jarol("run " + command + " --record " + log, "2>/dev/null").exit_code == 1);
    folder.write("mission.csv", titles + "0,0,0deg,0\n1,2,0deg,1\n3,2,0deg,1\n");
    const auto replay = run_jarol("replay " + log, "2>&1");
    CHECK(replay.exit_code == 1);
    CHECK(expected_lines(replay.output).starts_with("  expected    depth of dune > 1.9: FAILS: reached "));
    const auto of_now = run_jarol("replay " + log + " specs/exolauv.yaml", "2>&1");
    CHECK(of_now.exit_code == 0);
    CHECK(expected_lines(of_now.output) == "  expected    never supervisor.condition.alarm is not none: holds\n");
  }

  TEST_CASE("jarol vehicle, which no graph judges, refuses what a mission expects") {
    const TemporaryFolder folder;
    const std::string script = folder.write("script.csv", "expect: depth < 1\ntime,thruster\n0,0\n1,0\n");
    const auto run = run_jarol("vehicle submarine --script " + script + " --csv " + (folder / "motion.csv"), "2>&1");
    CHECK(run.exit_code == 2);
    CHECK(run.output ==
          script +
              ":1:9: error: 'expect' is for a mission of a graph, which jarol run judges; leave it out here\n"
              "  expect: depth < 1\n"
              "          ^\n1 error\n");
  }
}
