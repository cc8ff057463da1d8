// Every message that the loader and the validator can give has a file in specs/broken, and its whole text beside this.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <vector>

#include "graph/language/problems.h"
#include "graph/language/yaml.h"
#include "tools/commands/run/load_graph.h"
#include "tools/library/built_in.h"

namespace {
namespace fs = std::filesystem;

std::string text_of(const fs::path& path) { return jarol::read_source(path.string())->text; }

// A report says by names what there is: `<tasks>`, `<policies>`, `<vehicles>` and `<links of an operator>` stand for
// what is built in.
std::string with_names(std::string text) {
  const auto& known = jarol::built_in();
  std::vector<std::string> links;
  for (const auto& link : known.links.entries())
    if (!link.for_vehicles) links.push_back(link.name);
  const std::pair<std::string, std::vector<std::string>> lists[] = {
      {"<tasks>", jarol::names_of(known.graph.tasks())},
      {"<policies>", jarol::names_of(known.graph.policies())},
      {"<distributers>", jarol::names_of(known.graph.distributers())},
      {"<types of values>", known.graph.type_names()},
      {"<vehicles>", jarol::names_of(known.vehicles.entries())},
      {"<links of an operator>", links}};
  for (const auto& [mark, names] : lists)
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at))
      text.replace(at, mark.size(), jarol::list_of(names));
  return text;
}

// A graph named after what is wrong with a profile is loaded with that.
std::string report_on(const std::string& name) {
  const std::string profile = name.starts_with("profile_") ? "lab" : "";
  try {
    jarol::tools::load_graph("specs/broken/" + name + ".yaml", {profile, {}});
  } catch (const jarol::SpecError& error) { return error.what() + std::string("\n"); }
  return "";
}

// Words that no file can bring about, and the test of what does.
const std::vector<std::string> brought_about_elsewhere{
    // a command: tests/tools/plugins_test.cpp
    "plugin '", "' is not loaded: ",
    // the grammar of a plugin: tests/tools/plugins_grammar_test.cpp
    "timing grammar '", "' can't read this graph: ",
    // a program that adds to the registries: tests/distributers/registries_test.cpp
    "there is a '", "' already; names are unique",
    // a task of a program with values of more than 1 GiB: tests/graph/model/registry_test.cpp
    "' input", "' output", " bytes; values have at most 1GiB",
    // no error: tests/graph/expect/parse_test.cpp
    "' is not simulated in this process",
    // a communicator of such a type: tests/graph/expect/at_end_test.cpp
    "carries a value of changing size",
    // a distributer of a program, without parameters: tests/graph/model/parameters_test.cpp
    " has no parameters",
    // an option: tests/tools/commands/campaign/campaign_test.cpp
    "the lists and seeds that it varies have more than 1000000000 combinations; say how many runs there are",
    "' names no metric; write name=metric, as in deepest=max(depth of dune)",
    "it is not said how many runs there are; only lists and seeds come to an end of themselves",
    " is given twice; keep one",
    // an argument: tests/graph/language/override_test.cpp
    "' is no override; write path=value, as in ", "' gives no value; write path=value, as in ",
    // a value of a program's own: tests/graph/values/type_test.cpp
    " needs a mapping of its ", "is beyond what a float holds", "is a single word",
    // a log: tests/tools/log_mutations_test.cpp
    "ends before its bytes do", "has ", " where true or false stand", "ends before its length", "has a length of ",
    " and fewer bytes", "ends ", " bytes before they do",
    // what a task throws: tests/graph/values/sequence_test.cpp
    " of a sequence of ",
    // megabytes of text, no text at all: tests/graph/language/yaml_test.cpp
    "the text holds more than ", " values stand so close that each takes less than ", " values are empty",
    "the text is larger than ", "it is a directory", "it is larger than ",
    "it is no regular file; give - for what comes on stdin"};

// What messages are made of: the texts between quotes that have a blank in them, cut at numbers to come and line ends.
std::vector<std::string> words_of(const fs::path& source) {
  std::vector<std::string> words;
  std::istringstream lines(text_of(source));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t code = line.find_first_not_of(' ');
    if (code == std::string::npos || line[code] == '#' || line.compare(code, 2, "//") == 0) continue;
    if (line.compare(code, 6, "assert") == 0) continue;
    bool inside = false;
    std::string word;
    const auto end = [&] {
      const bool blanks = word.find_first_not_of(' ') == std::string::npos;
      if (inside && !blanks && word.find(' ') != std::string::npos && word.find('\\') == std::string::npos)
        words.push_back(word);
      word.clear();
    };
    for (std::size_t i = code; i < line.size(); ++i) {
      const bool number = line.compare(i, 3, "%zu") == 0;
      if (number || line.compare(i, 2, "\\n") == 0) {
        end();
        i += number ? 2 : 1;
      } else if (line[i] == '"') {
        end();
        inside = !inside;
      } else {
        word += line[i];
      }
    }
  }
  return words;
}

std::vector<std::string> broken_graphs() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator("specs/broken"))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}
}  // namespace

TEST_SUITE("tools/broken") {
  TEST_CASE("each broken graph gets the report that is expected, word for word") {
    const auto names = broken_graphs();
    CHECK(names.size() > 100);
    for (const std::string& name : names) {
#ifndef JAROL_VEHICLES
      if (name.starts_with("vehicle_")) continue;  // this build has no vehicles
#endif
      CAPTURE(name);
      const std::string expected = with_names(text_of("tests/tools/broken/" + name + ".txt"));
      CHECK(expected != "");
      CHECK(report_on(name) == expected);
    }
  }

  TEST_CASE("no message is without a file: all its words stand in a report that is expected") {
    std::string reports;
    for (const auto& entry : fs::directory_iterator("tests/tools/broken")) reports += text_of(entry.path());
    std::size_t seen = 0;
    for (const char* const folder :
         {"graph", "graph/campaign", "graph/expect", "graph/language", "graph/model", "graph/values"})
      for (const auto& entry : fs::directory_iterator(folder)) {
        // the tables hold what help and schema say
        const fs::path name = entry.path().filename();
        if ((name.extension() != ".cpp" && name != "key.h") || name == "tables.cpp" || name == "grammar.cpp") continue;
        // libraries, which tests/tools/plugins_test.cpp loads, and a task's fault, which no loader sees
        if (name.string().starts_with("plugin") || name == "floating_point.cpp" || name == "build_options.cpp")
          continue;
        // what is wrong with a checkpoint: tests/graph/values/archive_test.cpp
        if (name == "archive.cpp" || name == "heap_archive.cpp") continue;
        // a file that can't be edited: tests/tools/commands/check/measure_test.cpp
        if (name == "with_wcets.cpp") continue;
        for (const std::string& word : words_of(entry.path())) {
          ++seen;
          const auto& other = brought_about_elsewhere;
          if (std::find(other.begin(), other.end(), word) != other.end()) continue;
          CAPTURE(entry.path().string());
          CAPTURE(word);
          CHECK(reports.find(word) != std::string::npos);
        }
      }
    CHECK(seen > 150);  // it did read the sources
  }

  TEST_CASE("no expectation is left without its graph") {
    const auto names = broken_graphs();
    for (const auto& entry : fs::directory_iterator("tests/tools/broken"))
      CHECK(std::binary_search(names.begin(), names.end(), entry.path().stem().string()));
  }
}
