// Signals that end a run: cleanly, and also when they come twice.
#include <doctest/doctest.h>

#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/tools/default_signals.h"
#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::run_jarol;
using command::TemporaryFolder;
using command::until_taken;
}  // namespace

TEST_SUITE("tools/interrupt") {
  TEST_CASE("each signal ends a run with its report and trace, also when it comes again at once") {
    const command::DefaultSignals taken;
    const TemporaryFolder folder;
    // mostly at work, which is brought to its end
    const std::string graph = folder.write(
        "w.yaml",
        "{graph: g, tasks: {a: {type: Work, period: 70ms, on_fault: hold, parameters: {rounds: 50000000}}}}\n");
    for (const auto& each :
         std::vector<std::pair<std::string, std::string>>{{"INT", "130"}, {"TERM", "143"}, {"HUP", "129"}}) {
      const std::string signal = each.first, code = each.second;
      CAPTURE(signal);
      const std::string trace = folder / (signal + ".csv"), report = folder / (signal + ".txt");
      const std::string kill = "kill -" + signal + " $id";
      // two in a row, as from an impatient hand or a terminal and its shell; again where the machine was so busy that
      // they may have come half a second apart
      std::string text, took = "500";  // ms
      for (int attempt = 0; attempt < 20 && std::stoi(took) >= 500; ++attempt) {
        took =
            run_jarol("run " + graph + " --clock real --for 1h --trace " + trace + " > " + report,
                      "2>&1 & id=$!; " + until_taken + "sleep 0.05; begin=$(date +%s%N); " + kill + "; sleep 0.005; " +
                          kill + " 2>&-; wait $id; code=$?; echo $((($(date +%s%N) - begin) / 1000000)); " +
                          "echo \"exit code $code\" >> " + report)
                .output;
        text = content(report);
      }
      CHECK(text.find("real time (interrupted)\n") != std::string::npos);
      CHECK(text.ends_with("exit code " + code + "\n"));
      CHECK(std::filesystem::exists(trace));
    }
  }

  TEST_CASE("a run whose task never ends ends within a second of the first signal, and names it") {
    const command::DefaultSignals taken;
    const TemporaryFolder folder;
    std::filesystem::copy_file(JAROL_PLUGIN_FOLDER "/endless.so", folder / "endless.so",
                               std::filesystem::copy_options::overwrite_existing);
    const std::string graph =
        folder.write("g.yaml", "{graph: g, plugins: [endless.so], tasks: {a: {type: Endless, period: 10ms}}}\n");
    const std::string report = folder / "report.txt", trace = folder / "t.csv";
#ifdef JAROL_SANITIZED
    constexpr int longest = 3000;  // ms
#else
    constexpr int longest = 1000;
#endif
    std::string took = std::to_string(longest);
    for (int attempt = 0; attempt < 20 && std::stoi(took) >= longest; ++attempt)
      took =
          run_jarol("run " + graph + " --for 1s --trace " + trace + " > " + report,
                    "2>&1 & id=$!; " + until_taken + "sleep 0.05; begin=$(date +%s%N); kill -INT $id; wait $id; " +
                        "code=$?; echo $((($(date +%s%N) - begin) / 1000000)); echo \"exit code $code\" >> " + report)
              .output;
    CHECK(std::stoi(took) < longest);
    const std::string text = content(report);
    CHECK(text.find("g: 0 s on the virtual clock in ") != std::string::npos);
    CHECK(
        text.ends_with("error: task 'a' activation 0 at 0 s has not ended\n"
                       "error: threads have not ended; the program ends without them\n"
                       "error: trace and picture are not written, as the run has not ended\nexit code 3\n"));
    CHECK(!std::filesystem::exists(trace));
    for (const auto& entry : std::filesystem::directory_iterator(folder / ""))
      CHECK(entry.path().extension() != ".part");
  }

  TEST_CASE("so does one whose tasks never end on the threads of several workers, and names each") {
    const command::DefaultSignals taken;
    const TemporaryFolder folder;
    std::filesystem::copy_file(JAROL_PLUGIN_FOLDER "/ends.so", folder / "ends.so",
                               std::filesystem::copy_options::overwrite_existing);
    const std::string hangs = ": {type: Hangs, period: 10ms, parameters: {at: 100, loops: 100000}}";
    const std::string graph =
        folder.write("g.yaml", "{graph: g, plugins: [ends.so], tasks: {a" + hangs + ", b" + hangs + "}}\n");
    const std::string report = folder / "report.txt";
    std::string took = "1000", text;  // ms
    // again where the machine was so busy that it took long, or was asked to end too early
    for (int attempt = 0; attempt < 20 && (std::stoi(took) >= 1000 || text.find("not ended") == text.npos); ++attempt) {
      took =
          run_jarol("run " + graph + " --for 1h --workers 2 > " + report,
                    "2>&1 & id=$!; " + until_taken + "sleep 0.3; begin=$(date +%s%N); kill -INT $id; wait $id; " +
                        "code=$?; echo $((($(date +%s%N) - begin) / 1000000)); echo \"exit code $code\" >> " + report)
              .output;
      text = content(report);
    }
    CHECK(std::stoi(took) < 1000);
    CAPTURE(text);
    CHECK(text.find("error: task 'a' activation 100 at 1 s has not ended\n") != std::string::npos);
    if (std::thread::hardware_concurrency() > 1)  // else there is one worker
      CHECK(text.find("error: task 'b' activation 100 at 1 s has not ended\n") != std::string::npos);
    CHECK(text.ends_with("error: threads have not ended; the program ends without them\nexit code 3\n"));
  }

  TEST_CASE("under nohup a run goes on when its terminal is gone") {
    const command::DefaultSignals taken;
    const TemporaryFolder folder;
    // slow, so that a busy machine makes nothing late
    const std::string slow =
        "run " + folder.write("slow.yaml", "{graph: slow, tasks: {a: {type: Counter, period: 100ms, wcet: 1ms}}}\n") +
        " --clock real --for 300ms";
    const std::string hangs_up = "2>&1 & id=$!; sleep 0.1; kill -HUP $id; wait $id; echo \"exit code $?\"";
    CHECK(run_jarol(slow, hangs_up).output.ends_with("exit code 129\n"));
    const auto kept = run_jarol("schema > /dev/null; trap '' HUP; " JAROL_COMMAND " " + slow, hangs_up);
    CAPTURE(kept.output);
    CHECK(kept.output.find("slow: 0.3 s in real time\n") != std::string::npos);
    CHECK(kept.output.ends_with("exit code 0\n"));
  }

  TEST_CASE("a pipe that nobody reads, or a file at its limit, is an error of writing and ends no run") {
    const TemporaryFolder folder;
    const std::string report = folder / "report.txt", trace = folder / "t.csv";
    run_jarol("run specs/counting.yaml --clock real --for 1s --trace /dev/stdout", "2> " + report + " | true");
    CHECK(content(report).find("error: can't write '/dev/stdout': Broken pipe\n") != std::string::npos);
    const std::string log = folder / "c.log", picture = folder / "p.svg";
    run_jarol("run specs/counting.yaml --for 100s --log " + log);
    run_jarol("replay " + log + " --trace /dev/stdout --plot " + picture, "2> " + report + " | true");
    CHECK(content(report).find("error: can't write '/dev/stdout': Broken pipe\n") != std::string::npos);
    // it comes to its end all the same: one that a signal ended has no report
    const auto limited = run_jarol(
        "schema > /dev/null; ulimit -f 1; " JAROL_COMMAND " run specs/counting.yaml --for 100s --trace " + trace);
    CHECK(limited.output.starts_with("counting: 100 s on the virtual clock"));
    CHECK(limited.output.find("error: can't write '" + trace + "': File too large\n") != std::string::npos);
    CHECK(limited.exit_code == 3);
  }
}
