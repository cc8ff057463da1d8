// Each path that varies and each metric has a column of its own in the results.
#include <doctest/doctest.h>

#include "tests/tools/run_command.h"

using command::TemporaryFolder;

TEST_SUITE("tools/commands/campaign/columns") {
  TEST_CASE("a metric or a path whose column the results have already is bad input, and leaves no file") {
    const TemporaryFolder folder;
    const auto wrong = [&](const std::string& graph, const std::string& options) {
      const command::Result result =
          command::run_jarol("campaign " + graph + " --for 1s --results " + (folder / "r") + " " + options);
      CHECK(result.exit_code == 2);
      CHECK(!std::filesystem::exists(folder / "r"));
      return result.output;
    };
    for (const std::string name :
         {"run", "seed", "outcome", "why", "faults", "digest", "simulated_ns", "simulated_s", "Simulated_S"}) {
      const std::string metric = name + "=max(sum.out)";
      CHECK(wrong("specs/counting.yaml", "--vary seed=1..3 --metric '" + metric + "'") ==
            "--metric:1:1: error: metric '" + name +
                "' has the name of a column that all results have; choose another\n  " + metric + "\n  ^\n1 error\n");
    }
    CHECK(wrong("specs/counting.yaml", "--vary 'fault_limit=[1, 2]' --metric 'Fault_limit=max(sum.out)'") ==
          "--vary:1:1: error: 'fault_limit' and metric 'Fault_limit' would have one column of the results; give the "
          "metric another name\n  fault_limit=[1, 2]\n  ^\n1 error\n");
    const std::string graph =
        folder.write("g.yaml", "graph: g\ntiming: {period: 10ms}\ntasks: {a: {type: Counter}, A: {type: Counter}}\n");
    CHECK(wrong(graph, "--vary 'tasks.a.period=[10ms, 5ms]' --vary 'tasks.A.period=[10ms, 5ms]'") ==
          "--vary:1:1: error: 'tasks.A.period' differs from 'tasks.a.period' in case alone, as no two columns of the "
          "results may; vary one of them\n  tasks.A.period=[10ms, 5ms]\n  ^\n1 error\n");
  }
}
