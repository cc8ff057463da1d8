// Signals that end a run: cleanly, and also when they come twice.
#include <doctest/doctest.h>

#include <string>

#include "tests/tools/run_command.h"

namespace {
using command::jarol;
using command::TemporaryFolder;
}  // namespace

TEST_SUITE("tools/interrupt") {
  TEST_CASE("each signal ends a run with its report and trace, also when it comes again at once") {
    const TemporaryFolder folder;
    for (const std::string signal : {"INT", "TERM", "HUP"}) {
      CAPTURE(signal);
      const std::string trace = folder / (signal + ".csv"), report = folder / (signal + ".txt");
      // two in a row, as from an impatient hand or a terminal and its shell
      const std::string kill = "; sleep 0.02; kill -" + signal + " $id";
      jarol("run specs/counting.yaml --clock real --for 30s --trace " + trace + " > " + report,
            "2>&1 & id=$!; until [ -e " + trace + ".part ]; do sleep 0.05; done; sleep 0.3" + kill + kill +
                " 2>&-; wait $id; echo \"exit code $?\" >> " + report);
      std::ifstream file(report);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      CHECK(text.find("real time (interrupted)\n") != std::string::npos);
      CHECK(text.ends_with("exit code 130\n"));
      CHECK(std::filesystem::exists(trace));
    }
  }

  TEST_CASE("a run whose task never ends is ended by a second signal, half a second after the first, and says so") {
    const TemporaryFolder folder;
    std::filesystem::copy_file(JAROL_PLUGIN_FOLDER "/endless.so", folder / "endless.so",
                               std::filesystem::copy_options::overwrite_existing);
    const std::string graph =
        folder.write("g.yaml", "{graph: g, plugins: [endless.so], tasks: {a: {type: Endless, period: 10ms}}}\n");
    const std::string report = folder / "report.txt", trace = folder / "t.csv";
    jarol("run " + graph + " --for 1s --trace " + trace + " >> " + report,
          "2>&1 & id=$!; until [ -e " + trace + ".part ]; do sleep 0.05; done; sleep 0.3; kill -INT $id; sleep 0.8; " +
              "kill -0 $id && echo alive >> " + report +
              "; kill -INT $id; sleep 0.8; kill -INT $id 2>&-; wait $id; echo \"exit code $?\" >> " + report);
    std::ifstream file(report);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    CHECK(text == "alive\ninterrupted again: ended at once, without a report\nexit code 130\n");
  }
}
