// Sources are compiled together, so that what a file keeps to itself is seen by those that follow it: a private
// constant or function that hides a public one of a namespace around it would be taken for that there, and no compiler
// says so. Of types it mostly does.
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
const std::regex room(R"(^namespace ([\w:]+) \{)");

// Where a line stands: the namespaces that are open there, and whether they are private.
struct Place {
  std::vector<std::string> names;

  // Whether the line opens one or closes it.
  bool moves(const std::string& line) {
    std::smatch found;
    if (std::regex_search(line, found, room) || line == "namespace {") {
      names.push_back(found.empty() ? "" : found[1].str());
      return true;
    }
    if (names.empty() || !line.starts_with("}  // namespace")) return false;
    names.pop_back();
    return true;
  }

  bool is_private() const { return !names.empty() && names.back().empty(); }

  std::string space() const {
    std::string text;
    for (const std::string& name : names)
      if (!name.empty()) text += (text.empty() ? "" : "::") + name;
    return text;
  }
};

// Those that a call by a number fits, or by a text, or of exactly this class.
std::string kind_of(std::string parameter) {
  static const std::regex name(R"( ?\b\w+( = .*)?$)"),
      number(
          "(const )?(double|float|bool|char|(unsigned )?(int|long)|unsigned|"
          "std::size_t|std::u?int(8|16|32|64)_t)"),
      text(R"((const )?(std::string&?|std::string_view|char\*))");
  if (parameter.find(' ') != std::string::npos) parameter = std::regex_replace(parameter, name, "");
  if (std::regex_match(parameter, number)) return "number";
  return std::regex_match(parameter, text) ? "text" : parameter;
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
  Place place;
  for (std::string line; std::getline(in, line);)
    if (!place.moves(line) && !place.names.empty())
      if (const std::string name = declared_by(line); !name.empty()) names[name].insert(place.space());
}

std::string hidden_by(const fs::path& source, const Names& names, std::size_t& seen) {
  std::ifstream in(source);
  Place place;
  std::string wrong;
  for (std::string line; std::getline(in, line);) {
    if (place.moves(line) || !place.is_private()) continue;
    const std::string name = declared_by(line);
    if (name.empty()) continue;
    ++seen;
    const auto at = names.find(name);
    if (at == names.end()) continue;
    for (const std::string& around : at->second)
      if (place.space().starts_with(around + "::"))
        wrong += source.string() + ": " + name + " hides that of " + around + " from " + place.space() + "\n";
  }
  return wrong;
}
}  // namespace

TEST_SUITE("tree") {
  TEST_CASE("no private constant or function of a file hides a public one from those that are compiled with it") {
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
