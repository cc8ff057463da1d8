// The reference of the graph language has all that the loader knows, and nothing else.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "graph/language/tables.h"
#include "tools/commands/run/load_graph.h"
#include "tools/library/built_in.h"

namespace {
using namespace jarol;

struct Row {
  std::string key;
  std::vector<std::string> cells;  // after that of the key
};

// What stands between backticks.
std::vector<std::string> code_of(const std::string& text) {
  std::vector<std::string> code;
  std::size_t begin = text.find('`');
  while (begin != std::string::npos) {
    const std::size_t end = text.find('`', begin + 1);
    code.push_back(text.substr(begin + 1, end - begin - 1));
    begin = text.find('`', end + 1);
  }
  return code;
}

// The rows below each heading whose first cell is code.
void read_rows(const std::string& page, std::map<std::string, std::vector<Row>>& read) {
  std::istringstream text(read_source(page)->text);
  std::string section;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("## ") || line.starts_with("### ")) section = line.substr(line.find(' ') + 1);
    if (!line.starts_with("| `")) continue;
    Row row;
    for (std::size_t begin = 1; begin < line.size(); begin = line.find('|', begin) + 1)
      row.cells.push_back(line.substr(begin, line.find('|', begin) - begin));
    row.key = code_of(row.cells[0]).front();
    row.cells.erase(row.cells.begin());
    read[section].push_back(std::move(row));
  }
}

const std::map<std::string, std::vector<Row>>& reference() {
  static const auto sections = [] {
    std::map<std::string, std::vector<Row>> read;
    for (const char* page : {"specs/graphs.md", "specs/links.md", "specs/running.md"}) read_rows(page, read);
    return read;
  }();
  return sections;
}

const Row* find_row(const std::string& section, const std::string& key) {
  for (const Row& row : reference().at(section))
    if (row.key == key) return &row;
  return nullptr;
}

// The keys of the table with four columns below a heading.
std::string keys_in(const std::string& section) {
  std::vector<std::string> keys;
  for (const Row& row : reference().at(section))
    if (row.key.front() >= 'a') keys.push_back(row.key);
  std::sort(keys.begin(), keys.end());
  return list_of(keys);
}

std::string sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return list_of(names);
}

// Values as the reference shows them can be read as they stand.
template <class S>
void check_example(const Key<S>& key, const std::string& example) {
  Problems problems;
  const Yaml yaml = read_yaml(std::make_shared<Source>(Source{"example", key.name + ": " + example}), problems);
  S to;
  if (problems.empty() && key.read != nullptr) key.read(key, yaml.children.front(), to, "example", problems);
  for (const Problem& problem : problems.list()) FAIL_CHECK(key.name << ": " << example << ": " << problem.text);
}

template <class S>
void check_section(const std::string& section, const std::vector<Key<S>>& keys) {
  CAPTURE(section);
  CHECK(keys_in(section) == sorted(names_of(keys)));
  for (const Key<S>& key : keys) {
    const Row* row = find_row(section, key.name);
    if (row == nullptr) continue;
    CAPTURE(key.name);
    REQUIRE(row->cells.size() == 3);
    CHECK((row->cells[1] == " required ") == key.required);
    if (key.form == Form::choice) CHECK(sorted(code_of(row->cells[0])) == sorted(key.choices));
    for (const std::string& example : code_of(row->cells[0])) check_example(key, example);
  }
}

// What the loader says there is, where it has no key 'nothing'.
std::string keys_of_link(const std::string& link, const std::string& of = "dune") {
  try {
    tools::load_graph("specs/exolauv.yaml", {"", {"distributers." + of + ".link=" + link}});
  } catch (const SpecError& error) {
    const std::string before = "has no key 'nothing'; it has: ";
    for (const Problem& problem : error.problems())
      if (const std::size_t at = problem.text.find(before); at != std::string::npos)
        return problem.text.substr(at + before.size());
  }
  return "";
}

std::string sorted_words(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream text(list);
  for (std::string word; text >> word;) words.push_back(word.substr(0, word.find(',')));
  return sorted(words);
}
}  // namespace

TEST_SUITE("tools/graph_reference") {
  TEST_CASE("the reference has the keys of the loader's tables, with their choices and with examples that are right") {
    check_section("The file", graph_keys());
    check_section("timing", timing_keys(names_of(built_in().graph.grammars())));
    check_section("distributers", distributer_keys());
    check_section("communicators", communicator_keys());
    check_section("tasks", task_keys());
    check_section("chains", chain_keys());
    check_section("platform", platform_keys(names_of(built_in().graph.policies())));
    check_section("at_end", at_end_keys());
    check_section("campaign", campaign_keys());
  }

  TEST_CASE("the reference has the keys of each link") {
    for (const std::string& type : built_in().links.names()) {
      CAPTURE(type);
      const bool for_operators = built_in().links.find(type)->for_operators;
      const std::string keys = keys_of_link("{type: " + type + ", nothing: 1}", for_operators ? "neptus" : "dune");
      CHECK(keys != "");
      CHECK(keys_in(type) == sorted_words(keys));
    }
    CHECK(keys_in("port") == sorted_words(keys_of_link("{type: udp, listen: 7002, port: {in: {nothing: 1}}}")));
  }

  TEST_CASE("the reference has each distributer with its channels and parameters") {
    for (const DistributerClass& distributer : built_in().graph.distributers()) {
      CAPTURE(distributer.name);
      const Row* row = find_row("distributers", distributer.name);
      REQUIRE(row != nullptr);
      std::vector<std::string> in, out, parameters;
      for (const ChannelClass& c : distributer.channels) (c.direction == Direction::in ? in : out).push_back(c.name);
      if (distributer.parameters != nullptr) parameters = names_of(distributer.parameters->fields);
      CHECK(sorted(code_of(row->cells[0])) == sorted(in));
      CHECK(sorted(code_of(row->cells[1])) == sorted(out));
      CHECK(sorted(code_of(row->cells[2])) == sorted(parameters));
    }
  }
}
