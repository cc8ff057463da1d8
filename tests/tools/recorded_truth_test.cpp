// What a recording has of where its vehicle truly was, and what is judged by it.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::has;
using command::TemporaryFolder;

// The lines of a report that say what was expected.
std::string judged(const std::string& report) {
  std::istringstream lines(report);
  std::string all;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  expected ")) all += line + "\n";
  return all;
}

// A dive of which one condition about the true values holds and another does not.
std::string record_dive(const TemporaryFolder& folder) {
  const std::string file = folder / "dive.mcap";
  const auto run = command::run_jarol(
      "run specs/exolauv.yaml --profile at_sea --set 'expect=[depth of dune within 0.3 of 3, max(depth of "
      "dune) < 2]' --record " +
          file,
      "2>/dev/null");
  CHECK(run.exit_code == 1);
  folder.write("judged", judged(run.output));
  return file;
}

// A helicopter that loses a motor in flight; what is wrong with the run.
auto crash(const std::string& recorded) {
  return command::run_jarol(
      "run specs/javiator.yaml --set expect=nothing "
      "--set 'distributers.robostix.link.parameters.failures.front={kind: lost, at: 9}' " +
          recorded,
      "2>&1 >/dev/null");
}
}  // namespace

TEST_SUITE("tools/recorded_truth") {
  TEST_CASE("a replay judges by where the vehicle truly was, to the same words as the run") {
    const TemporaryFolder folder;
    const std::string file = record_dive(folder);
    const std::string of_run = content(folder / "judged");
    CHECK(of_run.find("  expected    depth of dune within 0.3 of 3: holds, ") != std::string::npos);
    CHECK(of_run.find("  expected    max(depth of dune) < 2: FAILS: reached 3.") != std::string::npos);
    const auto replay = command::run_jarol("replay " + file, "2>/dev/null");
    CHECK(judged(replay.output) == of_run);
    CHECK(replay.exit_code == 1);
    const auto report = command::run_jarol("log report " + file + " --out " + (folder / "dive.html"));
    CHECK(report.exit_code == 0);
    CHECK(content(folder / "dive.html").find(R"("max(depth of dune) \u003c 2","verdict":"fails","reached":3.)") !=
          std::string::npos);
  }

  TEST_CASE(
      "what became of a vehicle stands in the recording, and a replay or a report of it is as bad as the run was") {
    const TemporaryFolder folder;
    const std::string file = folder / "crash.mcap";
    const auto run = crash("--record-checkpoints 5s --record " + file);
    CHECK(run.exit_code == 1);
    const std::string begin = "error: the vehicle of 'robostix' has ";
    REQUIRE(run.output.starts_with(begin + "crashed: a rotor met the ground, at 9."));
    const std::string mishap = run.output.substr(begin.size(), run.output.size() - begin.size() - 1);
    const auto replay = command::run_jarol("replay " + file, "2>&1 >/dev/null");
    CHECK(replay.exit_code == 1);
    CHECK(replay.output == run.output);
    for (const std::string part : {" --only filter", " --set expect=nothing", " --from 12s"}) {
      CAPTURE(part);
      const auto same = command::run_jarol("replay " + file + part, "2>&1 >/dev/null");
      CHECK(same.exit_code == 1);
      CHECK(same.output == run.output);
    }
    // with other gains nobody knows where it would have gone
    CHECK(command::run_jarol("replay " + file + " --set tasks.altitude.parameters.kp=0.1", "2>&1 >/dev/null").output ==
          "");
    CHECK(command::run_jarol("log info " + file)
              .output.find("  mishap      the vehicle of 'robostix' has " + mishap + "\n") != std::string::npos);
    CHECK(command::run_jarol("log info --json " + file)
              .output.find(R"("mishaps":[{"distributer":"robostix","text":")" + mishap + "\"}]") != std::string::npos);
    CHECK(command::run_jarol("log report " + file + " --out " + (folder / "c.html")).exit_code == 0);
    CHECK(content(folder / "c.html").find(R"("verdict":{"negative":true)") != std::string::npos);
    CHECK(command::run_jarol("log trace " + file).output.find("has crashed: a rotor met the ground") !=
          std::string::npos);
  }

  TEST_CASE("what became of a vehicle stands in a recording of inputs alone, too") {
    const TemporaryFolder folder;
    const std::string file = folder / "inputs.mcap";
    const auto run = crash("--log " + file);
    CHECK(run.exit_code == 1);
    REQUIRE(run.output.starts_with("error: the vehicle of 'robostix' has crashed: "));
    const auto replay = command::run_jarol("replay " + file, "2>&1 >/dev/null");
    CHECK(replay.exit_code == 1);
    CHECK(replay.output == run.output);
  }

  TEST_CASE("recordings differ where vehicles truly moved otherwise, though nobody has measured it yet") {
    const TemporaryFolder folder;
    const auto record = [&](const std::string& name, const std::string& failure) {
      const std::string file = folder / name;
      REQUIRE(command::run_jarol("run specs/exolauv.yaml --for 6s --set expect=nothing --set "
                                 "distributers.dune.link.parameters.dynamics=rigid --record " +
                                 file + failure)
                  .exit_code == 0);
      return file;
    };
    const std::string sound = record("sound.mcap", "");
    const std::string stuck =
        record("stuck.mcap", " --set 'distributers.dune.link.parameters.failures.fin1={kind: hardover, at: 5951ms}'");
    const auto diff = command::run_jarol("log diff " + sound + " " + stuck);
    CHECK(diff.exit_code == 1);
    CHECK(diff.output.find("  first       jarol/truth/dune.depth at 5.97 s: was ") != std::string::npos);
    CHECK(command::run_jarol("log diff " + sound + " " + sound).exit_code == 0);
  }

  TEST_CASE("what is changed might have taken the vehicle elsewhere, and nothing is said of it") {
    const TemporaryFolder folder;
    const std::string file = record_dive(folder);
    const auto replay = command::run_jarol("replay " + file + " --set tasks.depth.parameters.kp=0.2", "2>/dev/null");
    CHECK(
        judged(replay.output)
            .find("  expected    6 conditions: not judged: the vehicle of 'dune' is not simulated in this process\n") !=
        std::string::npos);
  }

  TEST_CASE("a replay of another file that diverges is not judged by where the vehicle was; one that is the same is") {
    const TemporaryFolder folder;
    const std::string specs = folder / "specs", dive = folder / "dive.mcap";
    std::filesystem::copy("specs", specs, std::filesystem::copy_options::recursive);
    const std::string expect = "'expect=[depth of dune within 0.3 of 3, never supervisor.condition.alarm is not none]'";
    REQUIRE(command::run_jarol("run " + specs +
                               "/exolauv.yaml --set distributers.dune.link.parameters.dynamics=rigid --set " + expect +
                               " --record " + dive)
                .exit_code == 0);
    std::string text = content(specs + "/exolauv.yaml");
    const std::string task = "{type: DepthControl, ";
    const std::string same = folder.write("specs/same.yaml", text + "# a remark\n");
    REQUIRE(text.find(task) != std::string::npos);
    text.replace(text.find(task), task.size(), task + "parameters: {kp: 0.01}, ");
    const std::string other = folder.write("specs/other.yaml", text);
    CHECK(has(command::run_jarol("replay " + dive + " " + same).output,
              "  expected    depth of dune within 0.3 of 3: holds, "));
    const auto replay = command::run_jarol("replay " + dive + " " + other);
    CHECK(replay.exit_code == 1);
    const std::string why = "the vehicle might have gone elsewhere, as the replay has diverged";
    CHECK(has(replay.output, "  expected    5 conditions: not judged: " + why + "\n"));
    CHECK(has(replay.output, "  expected    never supervisor.condition.alarm is not none: holds\n"));
    CHECK(has(command::run_jarol("replay --json " + dive + " " + other, "2>/dev/null").output, why));
    CHECK(command::run_jarol("log report " + dive + " " + other + " --out " + (folder / "dive.html")).exit_code == 0);
    CHECK(has(content(folder / "dive.html"), R"("depth of dune within 0.3 of 3","verdict":"not_judged")"));
  }

  TEST_CASE("the true values stand in the recording as topics beside what is published, and only where all is") {
    const TemporaryFolder folder;
    const std::string file = record_dive(folder);
    const auto info = nlohmann::json::parse(command::run_jarol("log info --json " + file).output);
    std::uint64_t messages = 0;
    for (const auto& topic : info["topics"])
      if (topic["name"] == "jarol/truth/dune") messages = topic["messages"];
    CHECK(messages > 100 * 20);
    CHECK(info["truths"][0]["distributer"] == "dune");
    CHECK(command::run_jarol("log verify " + file).exit_code == 0);
    CHECK(command::run_jarol("run specs/exolauv.yaml --for 2s --record-what 'depth.*' --record " + file).exit_code ==
          0);
    CHECK(nlohmann::json::parse(command::run_jarol("log info --json " + file).output)["truths"].empty());
  }
}
