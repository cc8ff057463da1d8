// Whose fault an exception is, its type says, in the whole tree.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>

namespace {
namespace fs = std::filesystem;

// Where an exception without a type of its own is thrown on purpose: a port, trigger or compressor that the program
// uses wrongly; what a task did wrong, which is its fault; and programs of the build and the bench.
const std::set<std::string> may_throw_plainly{"graph/floating_point.cpp",
                                              "graph/values/heap.cpp",
                                              "runtime/jarol/port.h",
                                              "runtime/jarol/push_port.h",
                                              "runtime/jarol/slots.h",
                                              "runtime/jarol/time_trigger.cpp",
                                              "runtime/jarol/values_port.h",
                                              "runtime/mcap/compression.cpp",
                                              "tools/bench/checking.cpp",
                                              "tools/bench/message.cpp",
                                              "tools/bench/vehicles.cpp",
                                              "tools/commands/manual/main.cpp",
                                              "tools/commands/new/rover/vehicle/rover.cpp",
                                              "tools/messages/main.cpp"};
}  // namespace

TEST_SUITE("tree/thrown") {
  TEST_CASE("the type of what is thrown says who is at fault") {
    const std::regex plain(R"(throw std::(runtime_error|logic_error|invalid_argument|length_error|out_of_range)\b)");
    std::string wrong;
    std::set<std::string> seen;
    for (const char* top : {"graph", "runtime", "tasks", "distributers", "vehicles", "tools"})
      for (const auto& entry : fs::recursive_directory_iterator(top)) {
        const std::string extension = entry.path().extension(), file = entry.path();
        if (extension != ".h" && extension != ".cpp") continue;
        std::ifstream in(entry.path());
        std::size_t number = 1;
        for (std::string line; std::getline(in, line); ++number) {
          if (!std::regex_search(line, plain)) continue;
          seen.insert(file);
          if (!may_throw_plainly.contains(file))
            wrong += file + ":" + std::to_string(number) +
                     " throws what main takes for an error of this program; throw a type of graph/text/errors.h\n";
        }
      }
    CHECK(wrong == "");
    CHECK(seen == may_throw_plainly);
  }
}
