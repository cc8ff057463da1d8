#include "tests/isolation/expected.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/run_command.h"

namespace verdicts {
namespace {

constexpr std::string_view says = "// offends: ", begins = "TASK(";

Expected read_expected(const std::string& line) {
  // a symbol has "::" in it, and no space after that
  const std::size_t first = line.find(": "), second = line.find(": ", first + 1);
  return {line.substr(0, first), second == first ? "" : line.substr(first + 2, second - first - 2),
          line.substr(second + 2)};
}

std::string path_of(const nlohmann::json& violation) {
  std::string path;
  for (const auto& frame : violation["path"]) path += (path.empty() ? "" : " > ") + std::string(frame["function"]);
  return path;
}

// A path that ends with "..." goes on by functions of a library.
bool fits(const std::string& path, const std::string& expected) {
  constexpr std::string_view more = "...";
  if (!expected.ends_with(more)) return path == expected;
  return path.starts_with(expected.substr(0, expected.size() - more.size()));
}

bool is_met(const Expected& expected, const nlohmann::json& violations) {
  return std::any_of(violations.begin(), violations.end(), [&](const nlohmann::json& violation) {
    return violation["kind"] == expected.kind && violation["symbol"] == expected.symbol &&
           fits(path_of(violation), expected.path);
  });
}

// By the task's name, the comment lines right before it.
std::map<std::string, std::vector<std::string>> comments_in(const std::string& source) {
  std::map<std::string, std::vector<std::string>> all;
  std::vector<std::string> next;
  std::ifstream in(source);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("// ")) next.push_back(line);
    if (line.starts_with(begins)) all[line.substr(begins.size(), line.find(',') - begins.size())] = next;
    if (!line.starts_with("// ")) next.clear();
  }
  return all;
}

using Violations = std::map<std::string, nlohmann::json>;  // by the task's name

// `problem`: why there are none.
Violations violations_in(const std::string& library, std::string& problem) {
  const auto done = command::run_jarol("isolation --json " + library, "2>&1");
  Violations found;
  if (done.exit_code > 1) {
    problem = "exit code " + std::to_string(done.exit_code) + ": " + done.output;
    return found;
  }
  bool good = true;
  const auto json = nlohmann::json::parse(done.output);
  for (const auto& task : json["files"][0]["tasks"]) {
    found[task["name"]] = task["violations"];
    good = good && task["violations"].empty();
  }
  if (done.exit_code != (good ? 0 : 1)) problem = "exit code " + std::to_string(done.exit_code) + "\n";
  return found;
}

std::string text_of(const std::string& task, const nlohmann::json& violations) {
  std::string text = task + ":\n";
  for (const auto& violation : violations)
    text += "  " + std::string(violation["kind"]) + ": " + std::string(violation["symbol"]) + ": " +
            path_of(violation) + "\n";
  return text;
}

}  // namespace

std::map<std::string, std::vector<Expected>> expected_in(const std::string& source) {
  std::map<std::string, std::vector<Expected>> all;
  for (const auto& [task, comments] : comments_in(source)) {
    all[task];
    for (const std::string& line : comments)
      if (line.starts_with(says)) all[task].push_back(read_expected(line.substr(says.size())));
  }
  return all;
}

std::string differences(const std::string& library, const std::string& source) {
  std::string found;
  const auto expected = expected_in(source);
  const Violations all = violations_in(library, found);
  if (all.size() != expected.size()) found += std::to_string(all.size()) + " tasks\n";
  for (const auto& [task, violations] : all) {
    const auto known = expected.find(task);
    const bool met = known != expected.end() && known->second.empty() == violations.empty() &&
                     std::all_of(known->second.begin(), known->second.end(),
                                 [&, &reported = violations](const Expected& one) { return is_met(one, reported); });
    if (!met) found += text_of(task, violations);
  }
  return found;
}

std::string wrong_verdicts(const std::string& library, const std::string& source, const std::string& level) {
  std::string found;
  const auto expected = expected_in(source);
  const auto comments = comments_in(source);
  const Violations all = violations_in(library, found);
  if (all.size() != expected.size()) found += std::to_string(all.size()) + " tasks\n";
  for (const auto& [task, offends] : expected) {
    const auto& before = comments.at(task);
    const bool either = std::any_of(before.begin(), before.end(), [&](const std::string& line) {
      return line.starts_with("// may be rejected at " + level + ":");
    });
    const auto is = all.find(task);
    const bool rejected = is != all.end() && !is->second.empty();
    if (!either && rejected == offends.empty()) found += text_of(task, is == all.end() ? nlohmann::json() : is->second);
  }
  return found;
}

std::vector<std::string> isolation_sources() {
  return {"far", "globals", "imports", "innocent", "innocent_eigen", "instructions", "library", "values"};
}

}  // namespace verdicts
