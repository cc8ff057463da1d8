// Runs with a common past and other parameters from an instant on, side by side.
#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/tools/process.h"
#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::error_of;
using command::report_of;
using command::TemporaryFolder;
using nlohmann::json;
namespace tests = jarol::tests;

std::string line_with(const std::string& text, const std::string& begin) {
  const std::size_t at = text.find("\n" + begin);
  return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

const std::string window = "specs/window.yaml --for 3s ";
const std::string longer = "set=tasks.window.parameters.length=30";
}  // namespace

TEST_SUITE("tools/what_if") {
  TEST_CASE("one that changes nothing is the run to its end, another is what a resumed run is") {
    const TemporaryFolder folder;
    const std::string saved = folder / "saved", picture = folder / "picture.svg";
    const json report = report_of(window + "--what-if 'at=1s set=tasks.window.parameters.length=20' --what-if 'at=2s " +
                                  longer + "' --save 2s=" + saved + " --plot " + picture);
    CHECK(report["digest"] == report_of(window)["digest"]);
    REQUIRE(report["what_if"].size() == 2);
    const json &same = report["what_if"][0], &other = report["what_if"][1];
    CHECK(same["digest"] == report["digest"]);
    CHECK(same["first_difference"] == nullptr);
    CHECK(same["signals"].empty());
    CHECK(same["compared_values"] > 100);
    const json resumed = report_of(window + "--resume " + saved + " --set tasks.window.parameters.length=30");
    CHECK(other["digest"] == resumed["digest"]);
    // it keeps what it would have dropped at 2 s
    CHECK(other["at_ns"] == 2'000'000'000);
    CHECK(other["first_difference"]["instant_ns"] == 2'000'000'000);
    CHECK(other["first_difference"]["output"] == "window.out");
    const std::string svg = content(picture);
    CHECK(svg.find("what if 1") != std::string::npos);
    CHECK(svg.find("what if 2") != std::string::npos);
  }

  TEST_CASE("with any number of workers, and from a run that was resumed, it is the same") {
    const TemporaryFolder folder;
    const std::string what_if = "--what-if 'at=2s " + longer + "'";
    const json report = report_of(window + what_if)["what_if"];
    for (const std::string workers : {"2", "4"})
      CHECK(report_of(window + what_if + " --workers " + workers)["what_if"] == report);
    const std::string saved = folder / "saved";
    report_of(window + "--save 1s=" + saved);
    CHECK(report_of(window + what_if + " --resume " + saved)["what_if"] == report);
  }

  TEST_CASE("the report has runs side by side, and where and by how much each parts") {
    const command::Result result = command::run_jarol(
        "run " + window + "--what-if 'at=1s set=tasks.window.parameters.length=20' --what-if 'at=2s " + longer + "'");
    CHECK(result.exit_code == 0);
    CHECK(line_with(result.output, "  what if 2 ") == "  what if 2   at 2 s tasks.window.parameters.length=30");
    CHECK(line_with(result.output, "                 ").ends_with("the run           what if 1           what if 2"));
    CHECK(result.output.find("  what if 1   is the run, ") != std::string::npos);
    CHECK(result.output.find("  what if 2   parts from the run\n  first       window.out at 2 s: was ") !=
          std::string::npos);
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("a dive with another gain from 5 s on reaches another depth") {
    const std::string dive = "specs/exolauv.yaml --set expect=nothing --for 10s ";
    const json report = report_of(dive +
                                  "--what-if 'at=5s set=tasks.depth.parameters.kp=0.2 "
                                  "set=tasks.speed.parameters.kp=0.5'");
    const json& what_if = report["what_if"][0];
    CHECK(report["digest"] == report_of(dive)["digest"]);
    CHECK(what_if["digest"] != report["digest"]);
    CHECK(what_if["set"].size() == 2);
    // fins and propeller are at their limits at first
    CHECK(what_if["first_difference"]["instant_ns"] == 5'040'000'000);
    CHECK(what_if["reached"]["depth"]["value"] != report["outputs"]["to_neptus"]["depth"]);
    CHECK(what_if["truly_reached"]["depth"]["unit"] == "m");
    CHECK(what_if["judgement"]["negative"] == false);
  }
#endif

  TEST_CASE("one that is interrupted has no outcome, and the exit code is that of the signal") {
    const TemporaryFolder folder;
    const std::string saved = folder / "saved";
    tests::Process run(
        "run specs/window.yaml --for 100000s --what-if 'at=1s set=tasks.window.parameters.length=30' --save 99999s=" +
        saved);
    while (!std::filesystem::exists(saved) && run.runs()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // the run is over, its what-if is not
    run.interrupt();
    CHECK(run.end() == 130);
    CHECK(run.errors().find("error: what if at 1 s tasks.window.parameters.length=30 is not run") != std::string::npos);
    CHECK(run.output().find("what if") == std::string::npos);
    CHECK(run.output().find("digest") != std::string::npos);  // of the run
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("a vehicle that capsizes in a what-if stands in its report") {
    const std::string output =
        command::run_jarol(
            "run specs/javiator.yaml --for 15s --set expect=nothing --what-if 'at=8s "
            "set=tasks.attitude.parameters.lean.kd=0 set=tasks.attitude.parameters.lean.kp=-0.35'")
            .output;
    CHECK(line_with(output, "  failed").find("the vehicle of 'robostix' has capsized") != std::string::npos);
  }
#endif

  TEST_CASE("what faults leave out beyond the limit in a what-if stands in its report") {
    const std::string output = command::run_jarol(
                                   "run specs/window.yaml --for 1s --set tasks.window.on_fault=hold "
                                   "--what-if 'at=500ms set=tasks.window.parameters.length=60'")
                                   .output;
    CHECK(line_with(output, "  failed").find("fault limit of 10 %") != std::string::npos);
  }

  TEST_CASE("a window that is made shorter drops what is too old") {
    const json report = report_of(window + "--what-if 'at=2s set=tasks.window.parameters.length=5'")["what_if"][0];
    CHECK(report["first_difference"]["instant_ns"] == 2'000'000'000);
  }

  TEST_CASE("what is no what-if is refused with what would be one, before anything is run") {
    const std::string form = "; write it as in 'at=30s set=tasks.depth.parameters.kp=0.2'\n",
                      counting = "specs/counting.yaml --for 3s ";
    CHECK(error_of(counting + "--what-if 'at=1s'") == "error: --what-if: 'at=1s' does not say when and what" + form);
    CHECK(error_of(counting + "--what-if 'at=1s set=tasks.slow.let=5ms'") ==
          "error: --what-if: 'at=1s set=tasks.slow.let=5ms' sets 'tasks.slow.let=5ms', which is no parameter of a "
          "task" +
              form);
    CHECK(error_of("specs/window.yaml --for 1s --what-if 'at=2s " + longer + "'") ==
          "error: --what-if: the run ends at 1 s, before 2 s\n");
    CHECK(error_of(window + "--what-if 'at=1 " + longer + "'").find("error: --what-if: '1' ") == 0);
    CHECK(error_of("specs/window.yaml --for 1s --what-if 'at=500ms set=tasks.window.parameters.width=3'")
              .find("--what-if:1:1: error: task 'window' (Window) has no parameter 'width'") == 0);
    std::string five;
    for (int i = 0; i < 5; ++i) five += "--what-if 'at=1s " + longer + "' ";
    CHECK(error_of(window + five) == "error: --what-if: there are 5 of them, and at most 4 stand side by side\n");
    CHECK(error_of(window + "--clock real --what-if 'at=1s " + longer + "'") ==
          "error: --what-if belongs to the virtual clock\n");
  }
}
