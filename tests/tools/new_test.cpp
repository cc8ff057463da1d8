// jarol new makes a whole project or nothing. That what it makes builds and runs: tests/project.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "tests/tools/run_command.h"

namespace {
namespace fs = std::filesystem;
using command::content;
using command::TemporaryFolder;

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_SUITE("tools/new") {
  TEST_CASE("a project is named after its folder, and its files are said") {
    const TemporaryFolder folder;
    const std::string place = folder / "pump_2";
    CHECK(command::run_jarol("new " + place).output ==
          "made '" + place +
              "' with\n  .gitignore\n  CMakeLists.txt\n  README.md\n  plugin.cpp\n  pump_2.yaml\n  "
              "tasks/hold_level.h\n  tests/graph_test.cpp\nnext: cd " +
              place + " && cmake -B build && cmake --build build && ctest --test-dir build\n");
    CHECK(content(place + "/pump_2.yaml").find("graph: pump_2\n") != std::string::npos);
    for (const auto& entry : fs::recursive_directory_iterator(place))
      if (entry.is_regular_file()) CHECK(content(entry.path()).find("@NAME@") == std::string::npos);
    CHECK(names_in(folder / "") == std::vector<std::string>{"pump_2"});
    CHECK((fs::status(place).permissions() & fs::perms::others_read) != fs::perms::none);
  }

  TEST_CASE("an empty folder becomes the project, also by the name '.'") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "rover");
    CHECK(command::run_jarol("new . --vehicle", "2>&1",
                             "cd " + (folder / "rover") + " && " + fs::absolute(JAROL_COMMAND).string())
              .exit_code == 0);
    CHECK(names_in(folder / "rover") == std::vector<std::string>{".gitignore", "CMakeLists.txt", "README.md",
                                                                 "distributer", "messages", "plugin.cpp", "rover.yaml",
                                                                 "tasks", "tests", "vehicle"});
  }

  TEST_CASE(
      "a folder with anything in it, a file, and names that no project can have are refused, and nothing is made") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "full");
    folder.write("full/mine.txt", "mine");
    folder.write("file", "mine");
    fs::create_symlink(folder / "nothing", folder / "link");
    const std::string needs =
        "' can't name a project; it needs small letters, digits and _, up to 40, and a letter first\n";
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"full", "error: '" + (folder / "full") + "' is there, and not empty; give another name, or remove it\n"},
        {"file", "error: '" + (folder / "file") + "' is there, and no folder; give another name\n"},
        {"link", "error: '" + (folder / "link") + "' is a link to nothing; give another name, or remove it\n"},
        {"no/where",
         "error: there is no folder '" + (folder / "no") + "' to make '" + (folder / "no/where") + "' in\n"},
        {"Big", "error: 'Big" + needs},
        {"2nd", "error: '2nd" + needs},
        {"a-b", "error: 'a-b" + needs},
        {std::string(41, 'a'), "error: '" + std::string(41, 'a') + needs},
        {"test", "error: 'test' can't name a project, as it names a target of every build; choose another\n"},
        {"null", "error: 'null' can't name a project, as that is nothing in YAML; choose another\n"},
    };
    for (const auto& [name, says] : wrong) {
      const auto result = command::run_jarol("new " + (folder / name));
      CHECK(result.output == says);
      CHECK(result.exit_code == 2);
    }
    CHECK(names_in(folder / "") == std::vector<std::string>{"file", "full", "link"});
    CHECK(names_in(folder / "full") == std::vector<std::string>{"mine.txt"});
    CHECK(content(folder / "full/mine.txt") == "mine");
  }

  TEST_CASE("where it can't be written, nothing is left") {
    const auto result = command::run_jarol("new /proc/a");
    CHECK(result.output == "error: can't make '/proc/a': No such file or directory\n");
    CHECK(result.exit_code == 2);
    CHECK_FALSE(fs::exists("/proc/a"));
  }

  TEST_CASE("where there is no room for it, the folder that was to be made is named, and nothing is left") {
    const TemporaryFolder folder;
    const std::string place = folder / "pump";
    const auto result =
        command::run_jarol("new " + place, "2>&1", std::string("trap '' XFSZ; ulimit -f 1; ") + JAROL_COMMAND);
    CHECK(result.output == "error: can't make '" + place + "': File too large\n");
    CHECK(result.exit_code == 3);
    CHECK(names_in(folder / "").empty());
  }
}
