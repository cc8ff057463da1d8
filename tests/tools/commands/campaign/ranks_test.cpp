// One campaign on many processes, as mpirun starts them: what comes of it is what one process finds.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/tools/commands/campaign/database_content.h"
#include "tests/tools/default_signals.h"
#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::database_content;
using command::TemporaryFolder;

// So many ranks on this machine, however few processors it has.
command::Result ranks(int count, const std::string& arguments, const std::string& after = "2>&1") {
  return command::run_jarol(arguments, after,
                            "mpirun --allow-run-as-root --oversubscribe --bind-to none --mca btl self,vader --mca "
                            "btl_vader_single_copy_mechanism none -n " +
                                std::to_string(count) + " " JAROL_COMMAND);
}

const std::string counting =
    "campaign specs/counting.yaml --for 20s --vary tasks.slow.let='[5ms, 10ms, 15ms]' --vary seed=1..40 "
    "--metric 'last=final(sum.out)' --workers 2 ";
}  // namespace

TEST_SUITE("tools/commands/campaign/ranks") {
  TEST_CASE("for any number of ranks the table is the same, byte for byte, and the results hold the same") {
    const TemporaryFolder folder;
    REQUIRE(command::run_jarol(counting + "--results " + (folder / "alone") + " --csv " + (folder / "alone.csv"))
                .exit_code == 0);
    const std::string table = content(folder / "alone.csv"), results = database_content(folder / "alone");
    CHECK(std::count(results.begin(), results.end(), '\n') > 120);
    for (const int count : {1, 2, 4}) {
      CAPTURE(count);
      const std::string name = folder / std::to_string(count);
      const auto result =
          ranks(count, counting + "--json --results " + name + " --csv " + name + ".csv", "2>/dev/null");
      CHECK(result.exit_code == 0);
      CHECK(nlohmann::json::parse(result.output)["done"] == 120);
      CHECK(content(name + ".csv") == table);
      CHECK(database_content(name) == results);
    }
  }

  TEST_CASE("a rank that dies ends the job, and the same command goes on to the same table and results") {
    const command::DefaultSignals taken;
    const TemporaryFolder folder;
    const std::string of =
        "campaign specs/counting.yaml --for 1000s --vary seed=1..60 --metric 'last=final(sum.out)' "
        "--workers 1 ";
    REQUIRE(command::run_jarol(of + "--results " + (folder / "alone") + " --csv " + (folder / "alone.csv")).exit_code ==
            0);
    const std::string results = folder / "r", csv = folder / "r.csv";
    int killed = 0;
    for (int piece = 0; piece < 100 && !std::filesystem::exists(csv); ++piece) {
      // the last rank, once runs are being added; mpirun itself may then wait for a lock of its own for ever (Open MPI
      // 4.1 with PMIx 4.2, now and then)
      const auto part =
          ranks(3, of + "--results " + results + " --csv " + csv,
                "2>&1 & id=$!; until [ -s " + results +
                    "-wal ] || ! kill -0 $id 2>&-; do sleep 0.01; done; "
                    "sleep " +
                    std::to_string(0.1 * piece) +
                    "; kill -KILL $(pgrep -P $id | tail -n 1) 2>&-; { sleep 30; kill -KILL $id; } >&- 2>&- & "
                    "late=$!; wait $id; echo code $?; kill $late");
      killed += part.output.find("code 0\n") == std::string::npos ? 1 : 0;
    }
    CHECK(killed > 0);
    CHECK(content(csv) == content(folder / "alone.csv"));
    CHECK(database_content(results) == database_content(folder / "alone"));
  }

  TEST_CASE("what is wrong with a campaign is reported once, by the first rank") {
    const TemporaryFolder folder;
    const auto wrong = ranks(3, "campaign specs/counting.yaml --results " + (folder / "r"));
    CHECK(wrong.exit_code == 2);
    const std::string text =
        "error: 'specs/counting.yaml' is not for a campaign: it has no mission that ends; say how long a run is, as in "
        "--for 10s\n";
    CHECK(wrong.output.find(text) != std::string::npos);
    CHECK(wrong.output.find(text) == wrong.output.rfind(text));
    // of ranks that do not agree
    const auto apart = command::run_jarol(
        counting + "--results " + (folder / "r") + " : --allow-run-as-root --oversubscribe -n 1 " JAROL_COMMAND " " +
            counting + "--seed 7 --results " + (folder / "r"),
        "2>&1", "mpirun --allow-run-as-root --oversubscribe --mca btl self,vader -n 1 " JAROL_COMMAND);
    CHECK(apart.output.find("error: rank 1 of the campaign has another graph, other files or options, or another build "
                            "of jarol\n") != std::string::npos);
    CHECK(!std::filesystem::exists(folder / "r"));
  }
}
