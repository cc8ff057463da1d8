// Graphs on ordinary threads, as the command runs them.
#include <doctest/doctest.h>

#include "tests/tools/run_command.h"

TEST_SUITE("tools/threads") {
  TEST_CASE("a run on threads tells what was commanded and reached, as one of exotasks does") {
    const auto run =
        command::jarol("run specs/exolauv.yaml --clock real --concurrency threads --for 1.2s", "2>/dev/null");
    CHECK(run.exit_code == 0);
    CHECK(run.output.starts_with("exolauv: "));
    CHECK(
        run.output.find(" s in real time on threads\n               commanded     reached\n  depth            0.000") !=
        std::string::npos);
  }
}
