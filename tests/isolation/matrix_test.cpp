// The same verdicts whatever compiles the tasks: each level of optimisation, g++ and clang, with and without debug
// data, by the line of the README.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "tests/isolation/expected.h"
#include "tests/tools/run_command.h"

TEST_SUITE("isolation_matrix") {
  TEST_CASE("no verdict depends on the compiler, its optimisation or debug data") {
    const command::TemporaryFolder folder;
    for (const std::string compiler : {"g++", "clang++"}) {
      if (std::system(("command -v " + compiler + " > /dev/null").c_str()) != 0) continue;
      for (const std::string level : {"-O0", "-O1", "-O2", "-O3"})
        for (const std::string debug : {"", "-g -Wl,--emit-relocs"})
          for (const std::string& name : verdicts::isolation_sources()) {
            CAPTURE(compiler + " " + level + " " + debug + " " + name);
            const std::string source = "tests/isolation/" + name + ".cpp", library = folder / "library.so";
            const std::string line = compiler + " -std=c++20 " + level + " " + debug + " -ffp-contract=off " +
                                     (compiler == "g++" ? "-fno-gnu-unique " : "") +
                                     "-fPIC -shared -I . -I /usr/include/eigen3 -w " + source + " -o " + library;
            REQUIRE(std::system(line.c_str()) == 0);
            CHECK(verdicts::wrong_verdicts(library, source, level) == "");
          }
    }
  }
}
