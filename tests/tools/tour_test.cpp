// The pages do what they say: each command of specs/tour.md and specs/campaigns.md prints what stands there; those of
// specs/try.md end as they are to.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include "runtime/record/message_layout.h"
#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::TemporaryFolder;
namespace fs = std::filesystem;

struct Shown {
  std::string command;
  std::vector<std::string> pieces{""};  // of its output, one behind the other; "..." stands between them
};

// Those of the blocks that begin with one.
std::vector<Shown> commands_of(const std::string& page) {
  std::vector<Shown> commands;
  bool in_block = false, any = false;  // in this block
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      in_block = !in_block;
      any = false;
    } else if (in_block && line.starts_with("$ ")) {
      commands.push_back({line.substr(2)});
      any = true;
    } else if (any && line == "...") {
      commands.back().pieces.emplace_back();
    } else if (any) {
      commands.back().pieces.back() += line + "\n";
    }
  }
  return commands;
}

// Texts without how long it took.
std::string timeless(const std::string& text) {
  return std::regex_replace(text, std::regex(" of them in [0-9]+\\.[0-9] s"), " of them");
}

// Runs the commands of a page, and compares what they print; they find the tree in `folder`.
void check_commands(const std::vector<Shown>& commands, const TemporaryFolder& folder) {
  for (const Shown& shown : commands) {
    REQUIRE(shown.command.starts_with("build/release/jarol "));
    const std::string output =
        timeless(command::run_jarol("", "2>/dev/null", "cd " + (folder / "") + " && " + shown.command).output);
    CAPTURE(shown.command);
    CAPTURE(output);
    std::size_t at = 0;
    for (std::size_t i = 0; i < shown.pieces.size(); ++i) {
      const std::string piece = timeless(shown.pieces[i]);
      const std::size_t found = output.find(piece, at);
      REQUIRE(found != std::string::npos);
      // what is not left out follows at once
      if (i == 0) CHECK(found == 0);
      at = found + piece.size();
    }
    if (!shown.pieces.back().empty()) CHECK(at == output.size());
  }
}

// Where commands of pages find the graphs and the program.
void link_tree(const TemporaryFolder& folder) {
  fs::create_directories(folder / "build/release");
  fs::create_symlink(fs::absolute("specs"), folder / "specs");
  fs::create_symlink(fs::absolute(JAROL_COMMAND), folder / "build/release/jarol");
}
}  // namespace

TEST_SUITE("tools/tour") {
  TEST_CASE("each command of the tour prints what the tour shows, and the layout for PlotJuggler fits its recording") {
    const TemporaryFolder folder;
    link_tree(folder);
    const std::vector<Shown> commands = commands_of(content("specs/tour.md"));
    CHECK(commands.size() == 10);
    check_commands(commands, folder);

    const jarol::Recording recording(folder / "dive.mcap");
    std::set<std::string> names;
    for (const auto& [id, topic] : recording.topics()) {
      const jarol::MessageLayout layout(topic);
      for (const jarol::MessageColumn& column : layout.columns()) names.insert(topic.channel.topic + "/" + column.path);
    }
    const std::string layout = content("specs/exolauv.plotjuggler.xml");
    const std::regex curve("<curve name=\"([^\"]+)\"");
    std::size_t curves = 0;
    for (std::sregex_iterator found(layout.begin(), layout.end(), curve), end; found != end; ++found, ++curves) {
      CAPTURE((*found)[1].str());
      CHECK(names.contains((*found)[1].str()));
    }
    CHECK(curves == 6);
    // its pictures are there
    const std::string page = content("specs/tour.md");
    const std::regex picture("<img src=\"([^\"]+)\"");
    for (std::sregex_iterator found(page.begin(), page.end(), picture), end; found != end; ++found)
      CHECK(fs::exists("specs/" + (*found)[1].str()));
  }

  TEST_CASE("each command of the page of campaigns prints what that shows") {
    const TemporaryFolder folder;
    link_tree(folder);
    const std::vector<Shown> commands = commands_of(content("specs/campaigns.md"));
    CHECK(commands.size() == 2);
    check_commands(commands, folder);
  }

  TEST_CASE("each command that is shown to try ends with the verdict that it is to have") {
    const TemporaryFolder folder;
    link_tree(folder);
    const std::map<std::string, int> not_good{{"run specs/exolauv.yaml --set tasks.depth.parameters.kp=0.2", 1},
                                              {"replay dive.mcap --set tasks.depth.parameters.kp=0.2", 1},
                                              {"run specs/exolauv.yaml --set tasks.dept.period=20ms", 2}};
    // what is watched, answered by a peer or measures for long
    const std::regex endless("^(edit|console|vehicle|bench)| --console|--clock real");
    std::set<std::string> shown, run;
    for (const std::string file : {"README.md", "specs/try.md"}) {
      const std::string page = content(file);
      const std::regex in_words("`build/release/jarol ([^`]+)`");
      for (std::sregex_iterator found(page.begin(), page.end(), in_words), end; found != end; ++found) {
        const std::string arguments = (*found)[1];
        shown.insert(arguments);
        if (std::regex_search(arguments, endless) || arguments.find("low_pass") != std::string::npos) continue;
        if (!run.insert(arguments).second) continue;
        int expected = 0;
        for (const auto& [beginning, code] : not_good)
          if (arguments.starts_with(beginning)) expected = code;
        const command::Result result =
            command::run_jarol("", "2>&1 </dev/null", "cd " + (folder / "") + " && build/release/jarol " + arguments);
        CAPTURE(arguments);
        CAPTURE(result.output);
        CHECK(result.exit_code == expected);
      }
    }
    CHECK(shown.size() > 20);
    CHECK(run.size() > 15);
  }
}
