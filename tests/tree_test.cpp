// The shape of the tree: which folder may include which, and that nothing else stands at the top.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;

// What each folder may include besides itself.
const std::map<std::string, std::vector<std::string>> allowed{
    {"graph", {}},
    {"runtime", {"graph/"}},
    {"tasks", {"graph/"}},
    {"distributers", {"graph/", "runtime/", "tasks/values/", "vehicles/vehicle.h"}},
    {"vehicles", {"graph/", "distributers/messages/"}},
};

std::vector<std::string> project_includes(const fs::path& file) {
  std::vector<std::string> includes;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("#include \"")) includes.push_back(line.substr(10, line.find('"', 10) - 10));
  return includes;
}

bool is_allowed(const std::string& folder, const std::string& include) {
  if (include.starts_with(folder + "/")) return true;
  for (const std::string& prefix : allowed.at(folder))
    if (include.starts_with(prefix)) return true;
  return false;
}
}  // namespace

TEST_SUITE("tree") {
  TEST_CASE("includes follow the layers") {
    std::string wrong;
    std::size_t seen = 0;
    for (const auto& [folder, may] : allowed)
      for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension();
        if (extension != ".h" && extension != ".cpp") continue;
        for (const std::string& include : project_includes(entry.path())) {
          ++seen;
          if (!is_allowed(folder, include)) wrong += entry.path().string() + " includes " + include + "\n";
        }
      }
    CHECK(wrong == "");
    CHECK(seen > 100);  // it did read the tree
  }

  TEST_CASE("Simbody, Boost and yaml-cpp stay out of headers that others include") {
    std::string wrong;
    for (const auto& [folder, may] : allowed)
      for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        // what the one unit that knows Simbody shares within itself
        const bool in_unit = entry.path() == "vehicles/frames.h" || entry.path() == "vehicles/force_with_input.h";
        if (entry.path().extension() != ".h" || in_unit) continue;
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);)
          for (const char* library : {"<Simbody", "<SimTK", "<boost/", "<yaml-cpp/"})
            if (line.starts_with("#include " + std::string(library)))
              wrong += entry.path().string() + ": " + line + "\n";
      }
    CHECK(wrong == "");
  }

  TEST_CASE("at the top stand the eight folders and a few files") {
    const std::set<std::string> expected{"graph",     "runtime", "tasks", "distributers",   "vehicles",
                                         "specs",     "tests",   "tools", "CMakeLists.txt", "CMakePresets.json",
                                         "README.md", "LICENSE", "build"};
    std::string wrong;
    for (const auto& entry : fs::directory_iterator(".")) {
      const std::string name = entry.path().filename();
      if (name[0] != '.' && !expected.contains(name)) wrong += name + "\n";
    }
    CHECK(wrong == "");
  }
}
