// Some tasks of a recording by themselves: what they publish is compared, or the replay is refused.
#include <doctest/doctest.h>

#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::has;
using command::TemporaryFolder;

std::string graph_by_type(const std::string& type) {
  return "graph: g\ntiming: {period: 10ms}\ntasks:\n  a: {type: Counter, wcet: 10us}\n  b: {type: " + type +
         ", wcet: 10us}\n  c: {type: Relay, wcet: 10us}\nconnections: [a.out -> b.in, a.out -> c.in]\n";
}
}  // namespace

TEST_SUITE("tools/replay_only") {
  TEST_CASE("of an output that the recording has with another type tasks by themselves are not replayed") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", other = folder.write("other.yaml", graph_by_type("Window"));
    const std::string graph = folder.write("g.yaml", graph_by_type("Relay"));
    REQUIRE(command::run_jarol("run " + graph + " --for 1s --record " + file).exit_code == 0);
    for (const std::string tasks : {"b", "b c"}) {
      const auto replay = command::run_jarol("replay " + file + " " + other + " --only " + tasks);
      CHECK(replay.exit_code == 2);
      CHECK(replay.output ==
            "error: --only: the recording has values of another type of 'b.out', which these tasks publish, and they "
            "can't be compared; replay the graph of the run, or leave the task out\n");
    }
    CHECK(command::run_jarol("replay " + file + " " + other + " --only c").exit_code == 0);
    CHECK(command::run_jarol("replay " + file + " --only b c").exit_code == 0);
  }

  TEST_CASE("of an output that is not in the recording tasks by themselves are not replayed") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", graph = folder.write("g.yaml", graph_by_type("Relay"));
    REQUIRE(command::run_jarol("run " + graph + " --for 1s --record-what a.out,b.out --record " + file).exit_code == 0);
    const auto replay = command::run_jarol("replay " + file + " --only b c");
    CHECK(replay.exit_code == 2);
    CHECK(replay.output ==
          "error: --only: the recording has no values of 'c.out', which these tasks publish, and they can't be "
          "compared; record all that is published, jarol run --record, or leave the task out\n");
    CHECK(has(command::run_jarol("replay " + file + " --only b").output, "same        as the run"));
  }
}
