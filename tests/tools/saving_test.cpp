// Where a run is saved, and what becomes of it if it does not come there.
#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "tests/tools/process.h"
#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::error_of;
using command::report_of;
using command::TemporaryFolder;
namespace tests = jarol::tests;
}  // namespace

TEST_SUITE("tools/saving") {
  TEST_CASE("where a run can't be saved is said before it begins, and no other file is replaced") {
    const TemporaryFolder folder;
    const std::string notes = folder.write("notes.md", "# Notes\n"), nowhere = folder / "none/saved";
    const std::string run = "specs/counting.yaml --for 3s --save 1s=";
    CHECK(error_of(run + notes) ==
          "error: can't write '" + notes + "': it is there and no checkpoint; choose another file, or remove it\n");
    CHECK(command::content(notes) == "# Notes\n");
    CHECK(error_of(run + nowhere) == "error: can't write '" + nowhere + "': No such file or directory\n");
    CHECK(error_of("specs/counting.yaml --for 3s --save -5s=F") ==
          "error: --save: the run begins at 0 s, after -5 s\n");
    const std::string saved = folder / "saved";
    report_of(run + saved);
    report_of(run + saved);  // replaces a checkpoint
    report_of(run + folder.write("empty", ""));
  }

  TEST_CASE("a run that is interrupted before it is saved ends with the code of the signal") {
    const TemporaryFolder folder;
    tests::Process run("run specs/counting.yaml --for 100000h --record " + (folder / "r.mcap") +
                       " --save 50000h=" + (folder / "saved"));
    while (!std::filesystem::exists(folder / "r.mcap") && run.runs())
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    run.interrupt();
    CHECK(run.end() == 130);
    CHECK(run.errors().find("error: '" + (folder / "saved") + "' is not written, as the run has ended at ") !=
          std::string::npos);
  }

  TEST_CASE("log info says of a resumed run from where on it went on") {
    const TemporaryFolder folder;
    const std::string saved = folder / "saved", run = "specs/counting.yaml --for 3s ";
    report_of(run + "--save 1s=" + saved + " --record " + (folder / "whole.mcap"));
    report_of(run + "--resume " + saved + " --record " + (folder / "rest.mcap"));
    const std::string line =
        "\n  from        1 s on: the run went on there from what was saved, maybe with other parameters\n";
    CHECK(command::run_jarol("log info " + (folder / "rest.mcap")).output.find(line) != std::string::npos);
    CHECK(command::run_jarol("log info " + (folder / "whole.mcap")).output.find("\n  from ") == std::string::npos);
  }
}
