// The README and the pages of the folders show what the command really prints.
#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "graph/language/yaml.h"

namespace {
std::string output_of(const std::string& arguments) {
  std::string output;
  std::FILE* pipe = popen((std::string(JAROL_COMMAND) + " " + arguments).c_str(), "r");
  std::array<char, 4096> chunk{};
  for (std::size_t n = 0; (n = std::fread(chunk.data(), 1, chunk.size(), pipe)) > 0;) output.append(chunk.data(), n);
  pclose(pipe);
  return output;
}

std::string page(const std::string& path) { return jarol::read_source(path)->text; }
std::string readme() { return page("README.md"); }

// What stands between the two, where they come first.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t first = text.find(begin) + begin.size();
  return text.substr(first, text.find(end, first) - first);
}

// What is shown is the output from its first line to its last; lines "  ..." stand for what is left out.
bool is_shown(const std::string& shown, const std::string& output) {
  const std::string gap = "  ...\n";
  std::size_t begin = 0, at = 0, end = 0;
  for (; end != std::string::npos; begin = end + gap.size()) {
    end = shown.find(gap, begin);
    const std::string piece = shown.substr(begin, end - begin);
    const std::size_t found = output.find(piece, at);
    if (found == std::string::npos || (begin == 0 && found != 0)) return false;
    at = found + piece.size();
  }
  return at == output.size() || shown.ends_with(gap);
}

// The plugin that it shows compiles, and check says of its graph what the page says.
void check_plugin_page(const std::string& file, const std::string& plugin, const std::string& graph) {
  const std::string text = page(file), folder = JAROL_PLUGIN_FOLDER;
  CHECK(between(text, "```cpp\n", "```") == page("tests/tools/plugins/" + plugin));
  std::ofstream(folder + "/" + graph) << between(text, "$ cat " + graph + "\n", "$ jarol");
  const std::string said = between(text, "$ jarol check " + graph + "\n", "...\n");
  std::string verdict = output_of("check " + folder + "/" + graph + " 2>&1");
  for (std::size_t at; (at = verdict.find(folder + "/")) != std::string::npos;) verdict.erase(at, folder.size() + 1);
  CHECK(said.size() > 100);
  CHECK(verdict.starts_with(said));
}
}  // namespace

TEST_SUITE("tools/readme") {
  TEST_CASE("what check says of the demo stands on the page of the analysis, and in the README its parts") {
    const std::string verdict = output_of("check specs/exolauv.yaml");
    CHECK(verdict.size() > 300);
    const std::string command = "```\nbuild/release/jarol check specs/exolauv.yaml\n```\n\n```\n";
    CHECK(page("graph/analysis/README.md").find(command + verdict + "```\n") != std::string::npos);
    const std::string begin = "specs/exolauv.yaml: SCHEDULABLE";
    const std::string shown = begin + between(readme(), "```\n" + begin, "\nexolauv: 100 s");
    CHECK(shown.size() > 300);
    CHECK(is_shown(shown, verdict));
  }

  TEST_CASE("the page of the graphs shows a small one as it is, and what check says of it") {
    const std::string text = page("specs/README.md"), verdict = output_of("check specs/counting.yaml");
    CHECK(verdict.size() > 300);
    CHECK(between(text, "```yaml\n", "```") == page("specs/counting.yaml"));
    CHECK(between(text, "$ build/release/jarol check specs/counting.yaml\n", "```") == verdict);
  }

  TEST_CASE("what check says of the demo with a longer WCET stands in both places, too") {
    const std::string verdict = output_of("check specs/exolauv.yaml --set tasks.speed.wcet=60ms");
    CHECK(verdict.size() > 300);
    const std::string command = "check specs/exolauv.yaml --set tasks.speed.wcet=60ms\n";
    CHECK(page("graph/analysis/README.md").find(command + "```\n\n```\n" + verdict + "```\n") != std::string::npos);
    const std::string shown = between(readme(), "$ build/release/jarol " + command, "```");
    CHECK(shown.size() > 300);
    CHECK(is_shown(shown, verdict));
  }

  TEST_CASE("the picture of the README is what run --plot draws") {
    CHECK(output_of("run specs/exolauv.yaml --plot - 2>/dev/null") == page("specs/exolauv.svg"));
  }

  TEST_CASE("a message and a packet are shown as the command prints them") {
    for (const char* arguments : {"messages imc DesiredZ", "messages javiator --decode"}) {
      const bool decode = std::string(arguments).ends_with("--decode");
      const std::string output = output_of(std::string(arguments) + (decode ? " <<END\nffff0f021f400070\nEND" : ""));
      CHECK(output.size() > 100);
      CHECK(page("specs/messages/README.md").find(std::string(arguments) + "\n" + output) != std::string::npos);
    }
  }

  TEST_CASE("flying.md shows what is reported of a landing that nobody wanted") {
    const std::string sonar = " --set distributers.robostix.link.parameters.failures.sonar.";
    const std::string run = output_of("run specs/javiator.yaml" + sonar + "kind=lost" + sonar + "at=12s");
    const std::size_t begin = run.find("  event ");
    REQUIRE(begin != std::string::npos);
    CHECK(page("specs/flying.md").find(run.substr(begin)) != std::string::npos);
  }

  TEST_CASE("the README and the library's show tests of one's own as they are built against an installed tree") {
    CHECK(readme().find("```cpp\n" + page("tests/library/dive_test.cpp") + "```\n") != std::string::npos);
    for (const char* shown : {"tests/library/fed_test.cpp", "tests/library/recorded_test.cpp"})
      CHECK(page("tools/library/README.md").find("```cpp\n" + page(shown) + "```\n") != std::string::npos);
  }

  TEST_CASE("the README shows what the dive reaches as it is, flying.md what the flight does") {
    const std::string title = "               commanded";
    const std::string dive = output_of("run specs/exolauv.yaml");
    const std::string shown = title + between(readme(), title, "  trace ");
    CHECK(shown.size() > 300);
    CHECK(is_shown(shown, dive.substr(dive.find(title))));

    const std::string flight = output_of("run specs/javiator.yaml");
    const std::string reached = title + between(flight, title, "  digest");
    CHECK(reached.size() > 300);
    CHECK(page("specs/flying.md").find(reached) != std::string::npos);
  }

  TEST_CASE("flying.md shows where the helicopter lands whose sonar is lost") {
    const std::string sonar = "--set distributers.robostix.link.parameters.failures.sonar.";
    CHECK(page("specs/flying.md").find(sonar + "kind=lost \\\n  " + sonar + "at=12s") != std::string::npos);
    const std::string run = output_of("run specs/javiator.yaml " + sonar + "kind=lost " + sonar + "at=12s");
    const std::string reached = between(run, "deg\n  altitude", "  activations");
    CHECK(reached.size() > 80);
    CHECK(page("specs/flying.md").find(reached) != std::string::npos);
  }

  TEST_CASE("the README shows a task of one's own, and what a graph with it does") {
    const std::string text = readme(), folder = JAROL_PLUGIN_FOLDER;
    CHECK(between(text, "```cpp\n", "```") == jarol::read_source("tests/tools/plugins/low_pass.cpp")->text);
    std::ofstream(folder + "/smooth.yaml") << between(text, "```yaml\ngraph: smooth", "```").insert(0, "graph: smooth");
    const std::string run = output_of("run " + folder + "/smooth.yaml --for 1s --trace " + folder + "/smooth.csv");
    const std::string reported = "  activations" + between(run, "  activations", "  trace");
    CHECK(reported.size() > 60);
    CHECK(text.find(reported) != std::string::npos);
    const std::string trace = jarol::read_source(folder + "/smooth.csv")->text;
    const std::size_t last = trace.rfind('\n', trace.size() - 2);
    CHECK(text.find(trace.substr(last)) != std::string::npos);
  }

  TEST_CASE("the page of field types shows a task that compiles, and a graph that sets each of them") {
    const std::string text = page("graph/values/README.md"), folder = JAROL_PLUGIN_FOLDER;
    CHECK(between(text, "```cpp\n", "```") == page("tests/tools/plugins/field_types.cpp"));
    std::ofstream(folder + "/every_type.yaml") << between(text, "```yaml\n", "```");
    const std::string run = output_of("run " + folder + "/every_type.yaml --for 20ms --trace - 2>/dev/null");
    CHECK(run == "time,all.gain\n0,0.2\n0.01,0.2\n");
    // and no parameter is left out
    const std::string described = output_of("tasks FieldTypes --plugin " + folder + "/field_types.so");
    std::istringstream lines(between(described, "parameters\n", "\noutputs"));
    int fields = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("    ")) continue;  // words of an enumeration, members of a struct
      ++fields;
      const std::string name = line.substr(2, line.find(' ', 2) - 2);
      CHECK(text.find("\n      " + name + ": ") != std::string::npos);
    }
    CHECK(fields >= 12);
  }

  TEST_CASE("the page of the analysis shows a policy of one's own that compiles, and what check says with it") {
    check_plugin_page("graph/analysis/own_policy.md", "rate_monotonic.cpp", "rates.yaml");
  }

  TEST_CASE("the page of the graph shows a timing grammar of one's own that compiles, and what check says with it") {
    check_plugin_page("graph/README.md", "rates.cpp", "often.yaml");
  }
}
