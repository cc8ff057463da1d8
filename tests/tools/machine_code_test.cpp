// Whose machine code can't change the floating-point environment is not looked at after each activation.
#include "graph/plugins/machine_code.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "graph/plugins/plugins.h"
#include "tests/tools/plugin_library.h"
#include "tests/tools/run_command.h"
#include "tools/library/built_in.h"

namespace {
using namespace jarol;
using jarol::tests::library;

std::string rounds(int how) { return library("rounds_" + std::to_string(how)); }

[[maybe_unused]] bool is_trusted(const std::string& task, const std::string& path) {
  Registry registry = built_in().graph;
  REQUIRE(load_plugin(path, registry) == "");
  const TaskClass* const found = registry.find_task(task);
  REQUIRE(found != nullptr);
  return found->run == found->unchecked.run && found->body == found->unchecked.body;
}
}  // namespace

TEST_SUITE("tools/machine_code") {
  TEST_CASE("a file that is damaged or none of code is not trusted, whatever is in it") {
    const command::TemporaryFolder folder;
    const std::string reason = "is no object file that can be read here";
    CHECK(find_floating_point_change("nowhere.so") == reason);
    CHECK(find_floating_point_change(folder.write("text.so", "hello")) == reason);
    std::ifstream in(library("twice"), std::ios::binary);
    std::stringstream bytes;
    bytes << in.rdbuf();
    const std::string whole = bytes.str();
    for (std::size_t length = 0; length < whole.size(); length += whole.size() / 50)
      CHECK(find_floating_point_change(folder.write("cut.so", whole.substr(0, length))) == reason);
    // the place and number of the sections
    for (std::size_t at = 40; at < 64; ++at) {
      std::string bent = whole;
      bent[at] = static_cast<char>(bent[at] ^ 0x55);
      find_floating_point_change(folder.write("bent.so", bent));  // ends
    }
  }

#ifndef JAROL_SANITIZED  // sanitizers call what is unknown here
  TEST_CASE("what could change the floating-point environment is named") {
    CHECK(find_floating_point_change(rounds(1)) == "calls 'fesetround'");
    for (const int how : {2, 3, 4, 7, 8, 9, 11})
      CHECK(find_floating_point_change(rounds(how)) == "holds an instruction that loads it");
    CHECK(find_floating_point_change(rounds(5)) == "calls 'dlsym'");
    CHECK(find_floating_point_change(rounds(6)) ==
          "calls '_ZN5jarol26set_floating_point_controlERKNS_20FloatingPointControlE'");
    for (const int how : {12, 13}) CHECK(find_floating_point_change(rounds(how)) == "computes with x87 registers");
    CHECK(find_floating_point_change(rounds(10)) == "calls 'feenableexcept'");
    CHECK(find_floating_point_change(library("linked_fast_math")) == "holds an instruction that loads it");
    CHECK(find_floating_point_change(library("linked_elsewhere")) == "uses the library 'libz.so.1'");
  }

  TEST_CASE("ordinary tasks need no look") {
    for (const std::string name : {"twice", "hidden", "names", "low_pass", "field_types", "rounds_0"}) {
      CAPTURE(name);
      CHECK(find_floating_point_change(library(name)) == "");
    }
    CHECK(is_trusted("Twice", library("twice")));
    CHECK(!is_trusted("Rounds", rounds(1)));
  }

  TEST_CASE("the tasks that are built in, and the mathematics that they use, need no look") {
    std::istringstream objects(JAROL_TASK_OBJECTS);
    int count = 0;
    for (std::string object; std::getline(objects, object, ':'); ++count) {
      CAPTURE(object);
      CHECK(find_floating_point_change(object) == "");
    }
    CHECK(count > 15);
  }
#endif

  TEST_CASE("a plugin's task that leaves another environment behind has a fault, in whatever way it does so") {
    const command::TemporaryFolder folder;
    const std::vector<std::string> left = {"",
                                           "rounding upward",
                                           "rounding upward",
                                           "rounding upward",
                                           "rounding upward",
                                           "rounding upward",
                                           "rounding upward",
                                           "rounding of long double upward",
                                           "less precision of long double",
                                           "exceptions that raise a signal",
                                           "exceptions that raise a signal",
                                           "exceptions that raise a signal",
                                           "registers of long double in use",
                                           "registers of long double in use"};
    for (std::size_t how = 0; how < left.size(); ++how) {
      CAPTURE(how);
      const std::string graph = folder.write(
          "g.yaml", "graph: g\nplugins: [" + std::filesystem::absolute(rounds(static_cast<int>(how))).string() +
                        "]\ntiming: {period: 10ms}\ntasks: {a: {type: Rounds, isolation: weak}}\n");
      const auto done = command::run_jarol("run " + graph + " --for 100ms", "2>&1");
      CHECK(done.exit_code == (how == 0 ? 0 : 3));
      const std::string fault =
          "task 'a' activation 1 at 0.01 s: threw: left another floating-point environment behind: ";
      CHECK((done.output.find(fault + left[how] + "\n") != std::string::npos) == (how != 0));
    }
  }
}
