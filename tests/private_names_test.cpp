// Sources are compiled together, so that what a file keeps to itself is seen by those that follow it: a private name
// that hides a public one of a namespace around it would be taken for that there, and no compiler says so.
#include <doctest/doctest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;

const std::regex constant(
    R"(^(?:inline |static )*(?:constexpr|const|std::atomic<|std::mutex) ?[\w:<>,*& ]*[>*& ](\w+)(?:\[\w*\])* ?(?:=|\{|;))");
const std::regex function(
    R"(^(?!using|struct|class|enum|template|namespace|return|typedef)\w[\w:<>,*& ]*[>*& ](\w+)\(([^,)]*))");
const std::regex room(R"(^namespace (jarol[\w:]*) \{)");

// One that a call by a number fits, or of exactly this class.
std::string kind_of(std::string parameter) {
  static const std::regex name(R"( ?\b\w+( = .*)?$)");
  static const std::set<std::string> numbers{"double",      "float",        "int",          "bool",
                                             "std::size_t", "std::int64_t", "std::uint64_t"};
  if (parameter.find(' ') != std::string::npos) parameter = std::regex_replace(parameter, name, "");
  return numbers.contains(parameter) ? "number" : parameter;
}

// What a line at the margin declares: a constant's name, or a function's with the kind of its first parameter.
std::string declared_by(const std::string& line) {
  std::smatch found;
  if (std::regex_search(line, found, constant)) return found[1];
  if (std::regex_search(line, found, function)) return found[1].str() + "(" + kind_of(found[2]) + ")";
  return "";
}

// For each name the namespaces that have it.
using Names = std::map<std::string, std::set<std::string>>;

void add_public_names(const fs::path& header, Names& names) {
  std::ifstream in(header);
  std::string space;
  std::smatch found;
  for (std::string line; std::getline(in, line);)
    if (std::regex_search(line, found, room))
      space = found[1];
    else if (const std::string name = declared_by(line); !name.empty() && !space.empty())
      names[name].insert(space);
}

std::string hidden_by(const fs::path& source, const Names& names, std::size_t& seen) {
  std::ifstream in(source);
  std::string space, wrong;
  bool is_private = false;
  std::smatch found;
  for (std::string line; std::getline(in, line);) {
    if (std::regex_search(line, found, room)) space = found[1];
    if (line == "namespace {") is_private = true;
    if (line == "}  // namespace") is_private = false;
    const std::string name = is_private ? declared_by(line) : "";
    if (name.empty()) continue;
    ++seen;
    const auto at = names.find(name);
    if (at == names.end()) continue;
    for (const std::string& around : at->second)
      if (space.starts_with(around + "::"))
        wrong += source.string() + ": " + name + " hides that of " + around + " from " + space + "\n";
  }
  return wrong;
}
}  // namespace

TEST_SUITE("tree") {
  TEST_CASE("no private name of a file hides a public one from the files that are compiled with it") {
    Names names;
    std::string wrong;
    std::size_t seen = 0;
    constexpr std::array folders{"graph", "runtime", "tasks", "distributers", "vehicles", "tools"};
    for (const char* top : folders)
      for (const auto& entry : fs::recursive_directory_iterator(top))
        if (entry.path().extension() == ".h") add_public_names(entry.path(), names);
    for (const char* top : folders)
      for (const auto& entry : fs::recursive_directory_iterator(top))
        if (entry.path().extension() == ".cpp") wrong += hidden_by(entry.path(), names, seen);
    CHECK(names.size() > 1000);
    CHECK(seen > 1000);
    CHECK(wrong == "");
  }
}
