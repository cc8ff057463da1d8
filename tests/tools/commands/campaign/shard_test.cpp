// What --shard writes and reports is of its own runs, whatever else is in the results.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::TemporaryFolder;

// Six runs that break a limit, then six that do not.
const std::string twelve =
    "campaign specs/counting.yaml --for 1s --vary tasks.slow.let=[5ms,15ms] --vary seed=1..6 "
    "--metric 'last=final(sum.out) < 10000' ";

// What a campaign of those prints, without the time that it took.
command::Result run(const std::string& options) {
  command::Result result = command::run_jarol(twelve + options);
  result.output = std::regex_replace(result.output, std::regex("in [0-9]+\\.[0-9] s"), "in N s");
  return result;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string without_title(const std::string& table) { return table.substr(table.find('\n') + 1); }

// What is embedded in a page.
nlohmann::json page_data(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}
}  // namespace

TEST_SUITE("tools/commands/campaign/shard") {
  TEST_CASE("shards that share their results report and write their own runs alone, again and in any order") {
    const TemporaryFolder folder;
    const std::string results = folder / "r";
    const auto shard = [&](int i) {
      const std::string name = folder / std::to_string(i);
      return run("--shard " + std::to_string(i) + "/3 --results " + results + " --csv " + name + ".csv --report " +
                 name + ".html");
    };
    const auto third = shard(3);
    CHECK(third.exit_code == 0);
    CHECK(first_line(third.output) == "counting, shard 3/3 (runs 8 to 11): 4 of 4 runs, 4 good; 4 of them in N s");
    const auto first = shard(1);
    CHECK(first.exit_code == 1);
    CHECK(first_line(first.output) ==
          "counting, shard 1/3 (runs 0 to 3): 4 of 4 runs, 0 good, 4 bad; 4 of them in N s");
    const auto second = shard(2);
    CHECK(second.exit_code == 1);
    const std::string command = "    jarol run specs/counting.yaml --set tasks.slow.let=5ms --seed ",
                      bad = " is bad: metric 'last' is beyond its limit: it reached 10178\n";
    CHECK(second.output ==
          "counting, shard 2/3 (runs 4 to 7): 4 of 4 runs, 2 good, 2 bad; 4 of them in N s\n"
          "  metric           min           5 %        median          95 %           max\n"
          "  last            9630          9630          9630         10178         10178\n"
          "  worst last: 10178 in run 4\n" +
              command + "5 --for 1s --record run_4.mcap\n  run 4" + bad + command +
              "5 --for 1s --record run_4.mcap\n  run 5" + bad + command +
              "6 --for 1s --record run_5.mcap\n  results     " + results + "\n  report      " + (folder / "2.html") +
              "\n");
    CHECK(content(folder / "2.csv") ==
          "run,seed,tasks.slow.let,last,outcome,faults,simulated_s,digest,why,not_judged\n"
          "4,5,5ms,10178,bad,0,1,0xf68c8cf14a0b9eb6,metric 'last' is beyond its limit: it reached 10178,0\n"
          "5,6,5ms,10178,bad,0,1,0xf68c8cf14a0b9eb6,metric 'last' is beyond its limit: it reached 10178,0\n"
          "6,1,15ms,9630,good,0,1,0xc25a95cb432b2ad5,,0\n"
          "7,2,15ms,9630,good,0,1,0xc25a95cb432b2ad5,,0\n");
    const nlohmann::json page = page_data(content(folder / "2.html"));
    CHECK(page["report"]["shard"] == nlohmann::json({{"part", 2}, {"of", 3}, {"first", 4}, {"runs", 4}}));
    CHECK(page["report"]["done"] == 4);
    CHECK(page["index"] == "AAAAAAAAEEAAAAAAAAAUQAAAAAAAABhAAAAAAAAAHEA=");  // 4, 5, 6, 7
    const std::string table = content(folder / "1.csv");
    CHECK(first_line(shard(1).output) == "counting, shard 1/3 (runs 0 to 3): 4 of 4 runs, 0 good, 4 bad");
    CHECK(content(folder / "1.csv") == table);

    // all of them together are the campaign, which has nothing left to run
    const auto all = run("--results " + results + " --csv " + (folder / "all.csv"));
    CHECK(all.exit_code == 1);
    CHECK(first_line(all.output) == "counting: 12 of 12 runs, 6 good, 6 bad");
    CHECK(content(folder / "all.csv") ==
          table + without_title(content(folder / "2.csv")) + without_title(content(folder / "3.csv")));
    CHECK(run("--results " + (folder / "alone") + " --csv " + (folder / "alone.csv")).exit_code == 1);
    CHECK(content(folder / "alone.csv") == content(folder / "all.csv"));
  }

  TEST_CASE("a shard of one run names it, and one without runs has a table without rows") {
    const TemporaryFolder folder;
    const std::string results = "--results " + (folder / "r") + " ";
    CHECK(first_line(run(results + "--shard 12/12").output) ==
          "counting, shard 12/12 (run 11): 1 of 1 runs, 1 good; 1 of them in N s");
    const auto none = run(results + "--shard 1/13 --csv " + (folder / "none.csv"));
    CHECK(none.exit_code == 0);
    CHECK(first_line(none.output) == "counting, shard 1/13 (no runs): 0 of 0 runs, 0 good");
    CHECK(content(folder / "none.csv") ==
          "run,seed,tasks.slow.let,last,outcome,faults,simulated_s,digest,why,not_judged\n");
  }
}
