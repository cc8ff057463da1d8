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

bool is_met(const Expected& expected, const nlohmann::json& violations, bool paths) {
  return std::any_of(violations.begin(), violations.end(), [&](const nlohmann::json& violation) {
    return violation["kind"] == expected.kind && violation["symbol"] == expected.symbol &&
           (!paths || fits(path_of(violation), expected.path));
  });
}

}  // namespace

std::map<std::string, std::vector<Expected>> expected_in(const std::string& source) {
  std::map<std::string, std::vector<Expected>> all;
  std::vector<Expected> next;
  std::ifstream in(source);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(says)) next.push_back(read_expected(line.substr(says.size())));
    if (!line.starts_with(begins)) continue;
    all[line.substr(begins.size(), line.find(',') - begins.size())] = next;
    next.clear();
  }
  return all;
}

std::string differences(const std::string& library, const std::string& source, bool paths) {
  const auto expected = expected_in(source);
  const auto done = command::jarol("isolation --json " + library, "2>&1");
  const bool good = std::all_of(expected.begin(), expected.end(), [](const auto& task) { return task.second.empty(); });
  if (done.exit_code != (good ? 0 : 1)) return "exit code " + std::to_string(done.exit_code) + ": " + done.output;
  std::string found;
  const auto json = nlohmann::json::parse(done.output);
  const auto& tasks = json["files"][0]["tasks"];
  if (tasks.size() != expected.size()) found += std::to_string(tasks.size()) + " tasks\n";
  for (const auto& task : tasks) {
    const std::string name = task["name"];
    const auto known = expected.find(name);
    if (known == expected.end()) {
      found += name + " is not expected\n";
      continue;
    }
    const auto& violations = task["violations"];
    bool met = known->second.empty() == violations.empty();
    for (const Expected& one : known->second) met = met && is_met(one, violations, paths);
    if (met) continue;
    found += name + ":\n";
    for (const auto& violation : violations)
      found += "  " + std::string(violation["kind"]) + ": " + std::string(violation["symbol"]) + ": " +
               path_of(violation) + "\n";
  }
  return found;
}

std::vector<std::string> isolation_sources() {
  return {"globals", "imports", "innocent", "innocent_eigen", "instructions", "library"};
}

}  // namespace verdicts
