// The command as tools/demo builds it: its first subcommands, and what it says of the others.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/tools/run_command.h"
#include "tools/commands/commands.h"
#include "tools/commands/later.h"
#include "tools/report/command_line.h"

namespace {
using command::Result;

Result run_first(const std::string& arguments) { return command::run_jarol(arguments, "2>&1", JAROL_FIRST); }
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
}  // namespace

TEST_SUITE("tools/first") {
  TEST_CASE("it checks, runs and lists as the whole command does") {
    for (const std::string arguments :
         {"check specs/counting.yaml", "run specs/counting.yaml --for 1s --json", "tasks Counter"}) {
      CAPTURE(arguments);
      const Result first = run_first(arguments), whole = command::run_jarol(arguments);
      CHECK(first.exit_code == 0);
      if (!has(arguments, "run")) {
        CHECK(first.output == whole.output);
        continue;
      }
      // the time that it took differs
      const std::size_t digest = first.output.find("\"digest\"");
      REQUIRE(digest != std::string::npos);
      CHECK(has(whole.output, first.output.substr(digest, 32)));
    }
  }

  TEST_CASE("tools/build refuses options that don't stand first, and --first beside another word") {
    const auto refused = [](const std::string& words) { return command::run_jarol(words, "2>&1", "tools/build"); };
    const std::string alone = "error: --first stands alone: it builds no other targets, and no page\n";
    for (const std::string words : {"--page --first", "--first --page", "--first jarol"}) {
      CHECK(refused(words).output == alone);
      CHECK(refused(words).exit_code == 2);
    }
    CHECK(refused("jarol --page").output ==
          "error: '--page' is no target, and options stand first: tools/build [--page] [TARGET ...]\n");
  }

  TEST_CASE("of each other command, and of web pages, it says how to build them") {
    int exit_code = 0;
    std::vector<std::string> names{"check", "run", "tasks"};
    for (const std::string later : jarol::tools::later_commands) {
      names.push_back(later);
      const Result refused = run_first(later);
      CHECK(refused.exit_code == 2);
      CHECK(refused.output == "error: the command '" + later + "' is not built yet; tools/build builds all commands\n");
    }
    std::sort(names.begin(), names.end());
    CHECK(names == jarol::tools::make_command_line(exit_code).names());
    CHECK(jarol::tools::unbuilt_commands().empty());
    CHECK(run_first("run specs/counting.yaml --for 1s --console").output ==
          "error: the web pages of --console are not built yet; tools/build --page builds them, by npm\n");
    CHECK(has(run_first("--help").output, "tools/build builds the others: bench, campaign, console, "));
  }
}
