// The command: its report, its files, what resumes and what repeats.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/tools/commands/campaign/database_content.h"
#include "tests/tools/default_signals.h"
#include "tests/tools/run_command.h"
#include "tools/commands/campaign/campaign_report.h"
#include "tools/commands/campaign/repeat.h"

namespace {
using command::change_database;
using command::content;
using command::database_content;
using command::TemporaryFolder;
using nlohmann::json;
namespace tools = jarol::tools;
namespace campaign = jarol::campaign;

[[maybe_unused]] json json_of(const std::string& arguments, int exit_code = 0) {
  const command::Result result = command::run_jarol(arguments + " --json", "");
  CAPTURE(arguments);
  CHECK(result.exit_code == exit_code);
  return json::parse(result.output);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

[[maybe_unused]] std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) c == ',' ? cells.emplace_back() : cells.back() += std::string{c};
  return cells;
}
}  // namespace

TEST_SUITE("tools/commands/campaign") {
  TEST_CASE("a command that repeats a run has the words of a shell") {
    const campaign::Start start{.index = 3, .values = {}, .set = {"a.b=1", "a.c=[1, 2]"}, .seed = 9};
    CHECK(tools::repeat_command("my graph.yaml", {.profile = "wind", .set = {"a.d=2"}}, std::chrono::milliseconds(1500),
                                start) ==
          "jarol run 'my graph.yaml' --profile wind --set a.d=2 --set a.b=1 --set 'a.c=[1, 2]' --seed 9 --for 1.5s");
    CHECK(tools::repeat_command("g.yaml", {}, {}, {}) == "jarol run g.yaml --seed 0");
  }

  TEST_CASE("time left is shown as on a clock") {
    CHECK(tools::clock_text(0.2) == "0:01");
    CHECK(tools::clock_text(65) == "1:05");
    CHECK(tools::clock_text(7384) == "2:03:04");
  }

  TEST_CASE("what can't be a campaign is bad input, and says what would be right") {
    const TemporaryFolder folder;
    const auto wrong = [&](const std::string& arguments) {
      const command::Result result =
          command::run_jarol("campaign specs/counting.yaml --results " + (folder / "r") + " " + arguments);
      CHECK(result.exit_code == 2);
      return result.output;
    };
    CHECK(
        wrong("") ==
        "error: 'specs/counting.yaml' is not for a campaign: it has no mission that ends; say how long a run is, as in "
        "--for 10s\n");
    CHECK(wrong("--for 1s") ==
          "error: 'specs/counting.yaml' and its options make no campaign: it is not said how many runs there are; only "
          "lists and seeds come to an end of themselves, as in --runs 1000\n");
    CHECK(wrong("--for 1s --vary seed=1..100000 --vary 'tasks.count.wcet=grid(1us..2us, 100000)'") ==
          "error: 'specs/counting.yaml' and its options make no campaign: the lists and seeds that it varies have more "
          "than "
          "1000000000 combinations; say how many runs there are, as in --runs 1000\n");
    CHECK(wrong("--for 1s --runs 3 --shard 3/2") ==
          "error: --shard: '3/2' is no part of a whole; write it as 2/8, the second of eight\n");
    CHECK(wrong("--for 1s --runs 3 --metric 'max(sum.out)'") ==
          "--metric:1:1: error: 'max(sum.out)' names no metric; write name=metric, as in deepest=max(depth of dune)\n"
          "  max(sum.out)\n  ^\n1 error\n");
    const std::string what =
        ", as it is no value of a run; what can is the seed, or a path below one of timing, "
        "distributers, communicators, tasks, connections, chains, platform, expect, fault_limit, at_end";
    CHECK(wrong("--for 1s --vary 'campaign.runs=[1, 2]'") ==
          "--vary:1:1: error: 'campaign.runs' can't vary" + what + "\n  campaign.runs=[1, 2]\n  ^\n1 error\n");
    CHECK(wrong("--for 1s --vary 'graph=[a, b]'") ==
          "--vary:1:1: error: 'graph' can't vary" + what + "\n  graph=[a, b]\n  ^\n1 error\n");
    CHECK(wrong("--for 1s --runs 3 --csv " + (folder / "z") + " --report " + (folder / "./z")) ==
          "error: --csv and --report both name '" + (folder / "./z") + "'; choose another file for one of them\n");
    CHECK(wrong("--for 1s --runs 3 --report x.txt") ==
          "error: --report: 'x.txt' would hold a page in HTML; name it x.html\n");
    CHECK(wrong("--for 1s --runs 3 --report -") ==
          "error: --report: '-' is no file; a page is opened by its name, as in --report campaign.html\n");
    CHECK(wrong("--for 1s --runs 3 --vary tasks.nobody.period=1ms..2ms").find("has no 'nobody'") != std::string::npos);
    CHECK(!std::filesystem::exists(folder / "r"));
  }

  TEST_CASE("a metric or a path that is given twice is bad input, on the command line as in a file") {
    const TemporaryFolder folder;
    const std::string of = "campaign specs/counting.yaml --for 1s --results " + (folder / "r") + " ";
    const auto metrics =
        command::run_jarol(of + "--runs 3 --metric 'last=final(sum.out)' --metric 'last=max(sum.out)'");
    CHECK(metrics.exit_code == 2);
    CHECK(metrics.output ==
          "--metric:1:1: error: metric 'last' is given twice; keep one\n"
          "  last=max(sum.out)\n  ^\n"
          "--metric:1:1: note: first here\n"
          "  last=final(sum.out)\n  ^\n1 error\n");
    const auto paths = command::run_jarol(of + "--vary seed=1..3 --vary seed=7..9");
    CHECK(paths.exit_code == 2);
    CHECK(paths.output ==
          "--vary:1:1: error: 'seed' is given twice; keep one\n"
          "  seed=7..9\n  ^\n"
          "--vary:1:1: note: first here\n"
          "  seed=1..3\n  ^\n1 error\n");
    const std::string file = folder.write("g.yaml",
                                          "graph: g\ntiming: {period: 10ms}\ntasks: {a: {type: Counter}}\n"
                                          "campaign: {vary: {seed: 1..3, seed: 7..9}}\n");
    const auto in_file = command::run_jarol("campaign " + file + " --for 1s --results " + (folder / "r"));
    CHECK(in_file.exit_code == 2);
    CHECK(in_file.output == file +
                                ":4:31: error: key 'seed' appears twice in one mapping; keep one\n"
                                "  campaign: {vary: {seed: 1..3, seed: 7..9}}\n                                ^\n" +
                                file +
                                ":4:19: note: first here\n"
                                "  campaign: {vary: {seed: 1..3, seed: 7..9}}\n                    ^\n1 error\n");
    CHECK(!std::filesystem::exists(folder / "r"));
  }

  TEST_CASE("the same command goes on where it was killed or interrupted, to the same table and results") {
    const command::DefaultSignals taken;
    const TemporaryFolder folder;
    const std::string of =
        "campaign specs/counting.yaml --for 1000s --vary tasks.slow.let='[5ms, 10ms, 15ms]' --vary "
        "seed=1..20 --metric 'last=final(sum.out)' --workers 2 ";
    const command::Result whole =
        command::run_jarol(of + "--results " + (folder / "whole") + " --csv " + (folder / "whole.csv"));
    CHECK(whole.exit_code == 0);
    const std::string table = content(folder / "whole.csv");
    CHECK(lines_of(table).size() == 61);
    for (const std::string signal : {"KILL", "INT"}) {
      CAPTURE(signal);
      const std::string results = folder / signal, csv = folder / (signal + ".csv");
      int pieces = 0;
      for (bool done = false; !done && pieces < 200; ++pieces) {
        // the signal comes once runs are being added
        const command::Result part = command::run_jarol(
            of + "--results " + results + " --csv " + csv,
            "2>&1 & id=$!; until [ -s " + results + "-wal ] || ! kill -0 $id 2>&-; do sleep 0.01; done; sleep " +
                std::to_string(0.1 * pieces) + "; kill -" + signal + " $id 2>&-; wait $id; echo code $?");
        REQUIRE(part.output.find("code 2\n") == std::string::npos);
        done = part.output.find("code 0\n") != std::string::npos;
        if (!done && signal == "INT" && part.output.find("code 130") != std::string::npos)
          CHECK(part.output.find("runs are left; the same command goes on where this one ended\n") !=
                std::string::npos);
      }
      CHECK(pieces > 1);
      CHECK(content(csv) == table);
      CHECK(database_content(results) == database_content(folder / "whole"));
      CHECK(!std::filesystem::exists(results + "-wal"));
    }
  }

  TEST_CASE("results that no campaign has written are refused, with the run") {
    const TemporaryFolder folder;
    const std::string results = folder / "results",
                      of = "campaign specs/counting.yaml --for 1s --vary seed=1..3 --metric 'last=final(sum.out)' "
                           "--results " +
                           results;
    const auto changed = [&](const std::string& sql) {
      std::filesystem::remove(results);
      REQUIRE(command::run_jarol(of).exit_code == 0);
      change_database(results, sql);
      return command::run_jarol(of);
    };
    const auto refusal = [&](const std::string& what) {
      return "error: '" + results + "' has " + what + "; somebody has changed it\n";
    };
    const std::map<std::string, std::string> wrong{
        {"digest = 'zz'", "in run 1 a digest that is no hexadecimal number of 64 bits"},
        {"digest = NULL", "in run 1 a digest that is no hexadecimal number of 64 bits"},
        {"digest = '0x'", "in run 1 a digest that is no hexadecimal number of 64 bits"},
        {"digest = '0x12345678901234567'", "in run 1 a digest that is no hexadecimal number of 64 bits"},
        {"outcome = 'great'", "in run 1 an outcome that there is not"},
        {"faults = -3", "in run 1 a time or a number of faults that is no whole number from 0 on"},
        {"simulated_ns = 'x'", "in run 1 a time or a number of faults that is no whole number from 0 on"},
        {"last = 7", "in run 1 as 'last' what no run comes to"},
        {"last = x'07'", "in run 1 as 'last' what no run comes to"},
        {"last = 9e999", "in run 1 as 'last' what no run comes to"},
        {"run = 77", "a run 77, which is none of the campaign"},
        {"run = -1", "a run -1, which is none of the campaign"}};
    for (const auto& [set, why] : wrong) {
      const std::string& what = set;
      CAPTURE(what);
      const auto refused = changed("UPDATE runs SET " + what + " WHERE run = 1");
      CHECK(refused.exit_code == 2);
      CHECK(refused.output == refusal(why));
    }
    CHECK(changed("DELETE FROM runs WHERE run = 1").exit_code == 0);
  }

  TEST_CASE("a search for the mildest values that is interrupted says so, and the results stay") {
    const command::DefaultSignals taken;
    const TemporaryFolder folder;
    const std::string results = folder / "r";
    const std::string of =
        "campaign specs/counting.yaml --for 20000s --vary tasks.slow.let='[5ms, 10ms]' --metric "
        "'last=final(sum.out) < 1' --results " +
        results;
    REQUIRE(command::run_jarol(of).exit_code == 1);
    bool interrupted = false;
    for (int piece = 0; piece < 100 && !interrupted; ++piece) {
      // the search begins at once, as all runs are there; a signal before it ends the program as ever
      const command::Result part = command::run_jarol(
          of + " --shrink", "2>&1 & id=$!; " + command::until_taken + "sleep " + std::to_string(0.02 * piece) +
                                "; kill -INT $id 2>&-; wait $id; echo code $?");
      interrupted = part.output.find("interrupted: ") != std::string::npos;
      if (!interrupted) continue;
      CHECK(part.output.find("2 of 2 runs, 0 good, 2 bad") != std::string::npos);
      CHECK(
          part.output.ends_with("interrupted: the mildest values are not found; the same command searches again\n"
                                "code 130\n"));
    }
    CHECK(interrupted);
    CHECK(!std::filesystem::exists(results + "-wal"));
    const command::Result whole = command::run_jarol(of + " --shrink");
    CHECK(whole.exit_code == 1);
    CHECK(whole.output.find("  run 0 fails with each value at its mildest, too: metric 'last'") != std::string::npos);
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("dives are the same to the bit as runs of their own, for 1, 2 and 4 workers") {
    const TemporaryFolder folder;
    const std::string of =
        "campaign specs/exolauv.yaml --profile at_sea --for 5s --set expect=nothing --vary "
        "tasks.depth.parameters.kp=0.05..0.5 --vary 'distributers.dune.link.parameters.hull.mass=normal(18, 0.2)' "
        "--vary "
        "seed=1..6 --metric 'deepest=max(depth of dune)' ";
    const json one = json_of(of + "--workers 1 --results " + (folder / "1") + " --csv " + (folder / "1.csv"));
    CHECK(one["schema"] == "jarol.campaign/2");
    CHECK(one["done"] == 6);
    CHECK(one["outcomes"]["good"] == 6);
    const std::string table = content(folder / "1.csv");
    for (const std::string workers : {"2", "4"}) {
      json_of(of + "--workers " + workers + " --results " + (folder / workers) + " --csv " +
              (folder / (workers + ".csv")));
      CHECK(content(folder / (workers + ".csv")) == table);
      CHECK(database_content(folder / workers) == database_content(folder / "1"));
    }
    const std::vector<std::string> lines = lines_of(table);
    REQUIRE(lines.size() == 7);
    CHECK(lines[0] ==
          "run,seed,tasks.depth.parameters.kp,distributers.dune.link.parameters.hull.mass,deepest,outcome,"
          "faults,simulated_s,digest,why,not_judged");
    for (std::size_t i = 1; i < lines.size(); i += 2) {
      const std::vector<std::string> cells = cells_of(lines[i]);
      const json alone = json_of(
          "run specs/exolauv.yaml --profile at_sea --for 5s --set expect=nothing --set tasks.depth.parameters.kp=" +
          cells[2] + " --set distributers.dune.link.parameters.hull.mass=" + cells[3] + " --seed " + cells[1]);
      CHECK(alone["digest"] == cells[8]);
    }
    // the command of the worst case is that of its row
    const json& deepest = one["metrics"][0]["max"];
    const std::vector<std::string> row = cells_of(lines[static_cast<std::size_t>(deepest["run"]) + 1]);
    CHECK(deepest["command"] ==
          "jarol run specs/exolauv.yaml --profile at_sea --set expect=nothing --set tasks.depth.parameters.kp=" +
              row[2] + " --set distributers.dune.link.parameters.hull.mass=" + row[3] + " --seed " + row[1] +
              " --for 5s --record run_" + row[0] + ".mcap");
    CHECK(row[4] == json(deepest["value"]).dump());
  }
#endif
}
