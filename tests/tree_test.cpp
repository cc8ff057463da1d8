// The shape of the tree: which folder may include which, and that nothing else stands at the top.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
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
    {"distributers", {"graph/", "runtime/", "tasks/values/"}},
    {"vehicles", {"graph/", "distributers/messages/", "distributers/interfaces/"}},
};

constexpr std::array folders{"graph", "runtime", "tasks", "distributers", "vehicles", "specs", "tests", "tools"};

// How the names of files end that pages are named in.
const std::set<fs::path> kinds_of_code{".h", ".cpp", ".cmake", ".txt", ".yaml", ".ts", ".mjs", ".html", ".py", ""};

std::vector<std::string> project_includes(const fs::path& file) {
  std::vector<std::string> includes;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("#include \"")) includes.push_back(line.substr(10, line.find('"', 10) - 10));
  return includes;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_allowed(const std::string& folder, const std::string& include) {
  if (include.starts_with(folder + "/")) return true;
  for (const std::string& prefix : allowed.at(folder))
    if (include.starts_with(prefix)) return true;
  return false;
}

// The pages about the tree; what npm has fetched is none.
std::vector<fs::path> pages() {
  std::vector<fs::path> found{"README.md"};
  for (const char* top : folders)
    for (fs::recursive_directory_iterator entry(top), end; entry != end; ++entry) {
      if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
      if (entry->path().extension() == ".md") found.push_back(entry->path());
    }
  return found;
}

// By what a link names the sections of a page.
std::set<std::string> sections_of(const fs::path& page) {
  std::set<std::string> sections;
  std::ifstream in(page);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] != '#') continue;
    std::string name;
    for (const unsigned char c : line.substr(std::min(line.find_first_not_of('#') + 1, line.size())))
      if (std::isalnum(c) || c == '-' || c == '_')
        name += static_cast<char>(std::tolower(c));
      else if (c == ' ')
        name += '-';
    sections.insert(name);
  }
  return sections;
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

  TEST_CASE("no rooms include each other in a circle") {
    std::map<std::string, std::set<std::string>> rooms;  // what each folder includes
    for (const char* top : {"graph", "runtime", "tasks", "distributers", "vehicles", "tools"})
      for (const auto& entry : fs::recursive_directory_iterator(top)) {
        const std::string extension = entry.path().extension();
        if (extension != ".h" && extension != ".cpp") continue;
        const std::string room = entry.path().parent_path();
        for (const std::string& include : project_includes(entry.path()))
          if (const std::string other = fs::path(include).parent_path(); other != room) rooms[room].insert(other);
      }
    CHECK(rooms.size() > 20);
    // rooms that include none of those left are taken away until none is left, or a circle
    for (bool some = true; some;) {
      some = false;
      for (auto room = rooms.begin(); room != rooms.end();) {
        const bool last = std::none_of(room->second.begin(), room->second.end(),
                                       [&](const std::string& other) { return rooms.contains(other); });
        some = some || last;
        room = last ? rooms.erase(room) : std::next(room);
      }
    }
    std::string circle;
    for (const auto& [room, others] : rooms)
      for (const std::string& other : others)
        if (rooms.contains(other)) circle += room + " includes " + other + "\n";
    CHECK(circle == "");
  }

  TEST_CASE("Simbody, Boost and the libraries of YAML stay out of headers that others include") {
    std::string wrong;
    for (const auto& [folder, may] : allowed)
      for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        // what the one unit that knows Simbody shares within itself
        const bool in_unit = entry.path() == "vehicles/mechanics/frames.h" ||
                             entry.path() == "vehicles/mechanics/force_with_input.h" ||
                             entry.path() == "vehicles/mechanics/integrator_archive.h";
        if (entry.path().extension() != ".h" || in_unit) continue;
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);)
          for (const char* library : {"<Simbody", "<SimTK", "<boost/", "<yaml-cpp/", "<yaml.h>"})
            if (line.starts_with("#include " + std::string(library)))
              wrong += entry.path().string() + ": " + line + "\n";
      }
    CHECK(wrong == "");
  }

  TEST_CASE("the page of each folder names its rooms, and the main page the folders") {
    std::string wrong;
    for (const std::string folder : {"graph", "runtime", "tasks", "distributers", "vehicles", "tools"}) {
      const std::string page = text_of(folder + "/README.md");
      for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string room = entry.path().filename();
        if (entry.is_directory() && !fs::is_empty(entry) && room[0] != '_' &&
            page.find("`" + room + "/`") == std::string::npos)
          wrong += folder + "/README.md doesn't name " + room + "/\n";
      }
    }
    const std::string main = text_of("README.md");
    for (const std::string folder : folders)
      if (main.find("| [" + folder + "/](" + folder + "/README.md) |") == std::string::npos)
        wrong += "README.md doesn't name " + folder + "/\n";
    CHECK(wrong == "");
  }

  // a walk says it as `Class::function` (`file`), the file from its own folder or from the top
  TEST_CASE("each function that a walk through the code names is in the file that it names") {
    const std::regex named("`([A-Za-z_:]+)`,? \\(`([a-z_/]+\\.(?:h|cpp))`");
    std::string wrong;
    std::size_t seen = 0;
    for (const std::string folder : {"distributers", "runtime"}) {
      const std::string page = text_of(folder + "/README.md");
      for (std::sregex_iterator found(page.begin(), page.end(), named), end; found != end; ++found, ++seen) {
        const std::string function = (*found)[1], file = (*found)[2];
        const std::string beside = folder + "/" + file, code = text_of(fs::exists(beside) ? beside : file);
        // defined there, or declared
        const std::string name = file.ends_with(".cpp") ? function : function.substr(function.rfind(':') + 1);
        if (!std::regex_search(code, std::regex("\\b" + name + "\\(")))
          wrong += folder + "/README.md: " + function + " is not in " + file + "\n";
      }
    }
    CHECK(seen == 55);
    CHECK(wrong == "");
  }

  TEST_CASE("what a page links to is there, and so are its pictures and sections") {
    const std::regex link(R"--((?:\]\(|<img src=")([^)"#: ]*)(?:#([^)" ]+))?[)"])--");
    std::string wrong;
    std::size_t seen = 0;
    for (const fs::path& file : pages()) {
      const std::string page = text_of(file);
      for (std::sregex_iterator found(page.begin(), page.end(), link), end; found != end; ++found, ++seen) {
        const std::string to = (*found)[1], section = (*found)[2];
        const fs::path target = to.empty() ? file : file.parent_path() / to;
        if (!fs::exists(target) || (!section.empty() && !sections_of(target).contains(section)))
          wrong += file.string() + " links to " + (*found)[0].str() + ", which is not there\n";
      }
    }
    CHECK(wrong == "");
    CHECK(seen > 200);
  }

  // by its path from the top, in a comment, a message or a script
  TEST_CASE("a page that code names is there") {
    const std::regex named(
        R"((?:^|[^\w/])((?:graph|runtime|tasks|distributers|vehicles|specs|tests|tools)/[\w/]*\.md)\b)");
    std::string wrong;
    std::size_t seen = 0;
    for (const char* top : folders)
      for (fs::recursive_directory_iterator entry(top), end; entry != end; ++entry) {
        if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
        if (!entry->is_regular_file() || !kinds_of_code.contains(entry->path().extension())) continue;
        const std::string text = text_of(entry->path());
        for (std::sregex_iterator found(text.begin(), text.end(), named), none; found != none; ++found, ++seen)
          if (!fs::exists((*found)[1].str()))
            wrong += entry->path().string() + " names " + (*found)[1].str() + ", which is not there\n";
      }
    CHECK(wrong == "");
    CHECK(seen > 30);
  }

  // doctest adds 1 to the value of which epsilon is a share, so that 0.01 within 5 % would hold of 0, too.
  TEST_CASE("an Approx that is a share of its value has no scale beside it") {
    const std::regex share(R"(\)\.epsilon\((0\.\d|\de-[1-4]\)))");
    std::string wrong;
    for (const auto& entry : fs::recursive_directory_iterator("tests")) {
      if (entry.path().extension() != ".cpp" || entry.path().string().starts_with("tests/library/")) continue;
      std::ifstream in(entry.path());
      std::size_t number = 1;
      for (std::string line; std::getline(in, line); ++number)
        if (std::regex_search(line, share) && line.find(".scale(0)") == std::string::npos)
          wrong += entry.path().string() + ":" + std::to_string(number) + ": " + line + "\n";
    }
    CHECK(wrong == "");
  }

  // the nearest one above it, which may take all there are
  TEST_CASE("each test is in the list of its suite") {
    std::string missing;
    std::size_t tests = 0;
    for (const auto& entry : fs::recursive_directory_iterator("tests")) {
      const std::string name = entry.path().filename();
      if (!name.ends_with("_test.cpp")) continue;
      ++tests;
      fs::path folder = entry.path().parent_path();
      while (!fs::exists(folder / "CMakeLists.txt")) folder = folder.parent_path();
      const std::string list = text_of(folder / "CMakeLists.txt");
      const std::string listed = fs::relative(entry.path(), folder);
      if (list.find(listed) == std::string::npos && list.find("sources(all)") == std::string::npos)
        missing += entry.path().string() + "\n";
    }
    CHECK(missing == "");
    CHECK(tests > 200);
  }

  TEST_CASE("the packages that the demo needs are among those of all that is built") {
    std::vector<std::string> of_all;
    std::ifstream all("tools/apt-packages.txt"), first("tools/apt-packages-first.txt");
    for (std::string line; std::getline(all, line);) of_all.push_back(line);
    int count = 0;
    for (std::string line; std::getline(first, line); ++count) {
      CAPTURE(line);
      CHECK(std::find(of_all.begin(), of_all.end(), line) != of_all.end());
    }
    CHECK(count > 10);
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

  TEST_CASE("a file of more than 300 lines says in its head why it is one") {
    std::string wrong;
    std::size_t seen = 0;
    for (const char* top : {"graph", "runtime", "tasks", "distributers", "vehicles", "tools", "tests"})
      for (const auto& entry : fs::recursive_directory_iterator(top)) {
        const std::string extension = entry.path().extension();
        if (extension != ".h" && extension != ".cpp" && extension != ".svelte" && extension != ".ts") continue;
        if (entry.path().string().find("node_modules") != std::string::npos) continue;
        const std::string text = text_of(entry.path());
        ++seen;
        const auto lines = std::count(text.begin(), text.end(), '\n');
        const std::string head =
            text.substr(0, std::min({text.find("#include"), text.find("#pragma"), text.find("<script")}));
        if (lines > 300 && head.find("In one file: ") == std::string::npos)
          wrong += entry.path().string() + " has " + std::to_string(lines) + " lines\n";
      }
    CHECK(wrong == "");
    CHECK(seen > 500);
  }
}
