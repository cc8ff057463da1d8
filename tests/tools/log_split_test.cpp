// Recordings that are split over several files.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::has;
using command::json_report;
using command::TemporaryFolder;
namespace fs = std::filesystem;

// Some 4 MB in 30 s, as its windows are deep.
std::string graph_in(const TemporaryFolder& folder, int length = 500) {
  return folder.write("g" + std::to_string(length) + ".yaml", R"(graph: g
tasks:
  count: {type: Counter, period: 10ms}
  sum: {type: Accumulate, period: 10ms}
  window: {type: Window, period: 30ms, heap: 64KiB, parameters: {length: )" +
                                                                  std::to_string(length) + R"(}}
  mean: {type: Mean, period: 30ms}
connections: [count.out -> sum.in, sum.out -> window.in, window.out -> mean.in]
)");
}

const std::string split = " --record-compression none --record-split 1MiB";

std::string record(const TemporaryFolder& folder, const std::string& name, const std::string& more) {
  const std::string file = folder / name;
  REQUIRE(command::run_jarol("run " + graph_in(folder) + " --for 30s --record " + file + more).exit_code == 0);
  return file;
}

void flip(const std::string& file, std::uintmax_t at) {
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekg(static_cast<std::streamoff>(at));
  const char old = static_cast<char>(bytes.get());
  bytes.seekp(static_cast<std::streamoff>(at));
  bytes.put(static_cast<char>(old ^ 1));
}
}  // namespace

TEST_SUITE("tools/log_split") {
  TEST_CASE("a recording that is split is read by its first file as one that is not") {
    const TemporaryFolder folder;
    const std::string one = record(folder, "one.mcap", " --record-compression none");
    const std::string first = record(folder, "r.mcap", split + " --record-checkpoints 7s");
    const auto info = json_report("log info " + first);
    CHECK(info["whole"] == true);
    const auto parts = info["parts"].get<std::vector<std::string>>();
    REQUIRE(parts.size() >= 3);
    std::uintmax_t bytes = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      CHECK(parts[i] == folder / (i == 0 ? "r.mcap" : "r." + std::to_string(i + 1) + ".mcap"));
      CHECK(fs::file_size(parts[i]) < (std::uintmax_t{1} << 20) + (1U << 19));  // and indexes
      if (i + 1 < parts.size()) CHECK(fs::file_size(parts[i]) > (std::uintmax_t{1} << 19));
      bytes += fs::file_size(parts[i]);
    }
    CHECK(info["bytes"] == bytes);
    CHECK(!fs::exists(folder / ("r." + std::to_string(parts.size() + 1) + ".mcap")));
    CHECK(
        has(command::run_jarol("log info " + first).output, " chunks of " + std::to_string(parts.size()) + " files\n"));
    const auto replay = json_report("replay " + first), whole = json_report("replay " + one);
    CHECK(replay["verdict"] == "same");
    CHECK(replay["compared_values"] == whole["compared_values"]);
    CHECK(replay["digest"] == whole["digest"]);
    const auto from = json_report("replay " + first + " --from 22s");
    CHECK(from["verdict"] == "same");
    CHECK(from["begun_ns"] == 21'000'000'000);
    CHECK(from["digest"] == whole["digest"]);
    CHECK(command::run_jarol("log diff " + one + " " + first).exit_code == 0);
    CHECK(command::run_jarol("log verify " + first).exit_code == 0);
    for (const std::string look : {"csv", "cat"})
      CHECK(command::run_jarol("log " + look + " " + first).output ==
            command::run_jarol("log " + look + " " + one).output);
    CHECK(command::run_jarol("log cat --from 25s --until 26s " + first).output ==
          command::run_jarol("log cat --from 25s --until 26s " + one).output);
  }

  TEST_CASE("another part than the first is none by itself") {
    const TemporaryFolder folder;
    record(folder, "r.mcap", split);
    const std::string second = folder / "r.2.mcap";
    for (const std::string words : {"replay ", "log info ", "log verify "}) {
      const auto said = command::run_jarol(words + second);
      CHECK(said.exit_code == 2);
      CHECK(said.output == "error: '" + second + "' is part 2 of a recording that is split; give its first part\n");
    }
  }

  TEST_CASE("where a part is missing the recording breaks off, and what is before it is looked into") {
    const TemporaryFolder folder;
    const std::string first = record(folder, "r.mcap", split), third = folder / "r.3.mcap";
    fs::remove(third);
    const std::string breaks =
        "breaks off after '" + folder / "r.2.mcap" + "', and there is no '" + third + "' that follows it";
    const auto info = command::run_jarol("log info " + first);
    CHECK(json_report("log info " + first)["parts"].size() == 2);
    CHECK(command::run_jarol("log cat --topic mean.out " + first).output.size() > 10000);
    CHECK(has(info.output, "  " + breaks + "; how the run ended is not known\n"));
    CHECK(command::run_jarol("log verify " + first).output == "error: '" + first + "' " + breaks + "\n");
    const auto replay = command::run_jarol("replay " + first);
    CHECK(replay.exit_code == 3);
    CHECK(has(replay.output, "  log         " + breaks + ", before "));
  }

  TEST_CASE("what a fast run takes in lies in each part, so that all but a lost last one is replayed") {
    const TemporaryFolder folder;
    const std::string first = folder / "r.mcap";
    REQUIRE(command::run_jarol("run " + graph_in(folder) + " --for 300s --record " + first + split).exit_code == 0);
    const auto parts = json_report("log info " + first)["parts"].get<std::vector<std::string>>();
    REQUIRE(parts.size() > 20);
    fs::remove(parts.back());
    CHECK(json_report("log info " + first)["covered_ns"] > 200'000'000'000);
    CHECK(json_report("replay " + first)["compared_values"] > 40'000);
  }

  TEST_CASE("a part of another run, or a damaged one, is not taken for what follows") {
    const TemporaryFolder folder;
    const std::string first = record(folder, "r.mcap", split), second = folder / "r.2.mcap";
    SUBCASE("of another run") {
      const std::string other = folder / "other.mcap";
      REQUIRE(command::run_jarol("run " + graph_in(folder, 499) + " --for 30s --record " + other + split).exit_code ==
              0);
      fs::rename(folder / "other.2.mcap", second);
      CHECK(has(command::run_jarol("log info " + first).output,
                "breaks off after '" + first + "', and there is no '" + second + "' that follows it"));
    }
    SUBCASE("of another run with the same sizes") {
      const std::string other = folder / "other.mcap";
      REQUIRE(command::run_jarol("run " + graph_in(folder) + " --set tasks.count.init.out=1 --for 30s --record " +
                                 other + split)
                  .exit_code == 0);
      fs::rename(folder / "other.2.mcap", second);
      CHECK(command::run_jarol("log verify " + first).exit_code == 1);
    }
    SUBCASE("damaged") {
      flip(second, fs::file_size(second) / 2);
      const auto verified = command::run_jarol("log verify " + first);
      CHECK(verified.exit_code == 1);
      CHECK(verified.output.starts_with("error: '" + second + "' at byte "));
      CHECK(command::run_jarol("replay " + first).exit_code == 3);
    }
  }

  TEST_CASE("what can't be split says why") {
    const TemporaryFolder folder;
    const std::string run = "run " + graph_in(folder) + " --for 1s ", file = folder / "r.mcap";
    CHECK(command::run_jarol(run + "--record-split 1MiB").output ==
          "error: --record-split is about --record and --log; add one of them, or leave it out\n");
    CHECK(command::run_jarol(run + "--record-split 1023KiB --record " + file).output ==
          "error: --record-split: '1023KiB' is below 1MiB\n");
    CHECK(command::run_jarol(run + "--record-split 10 --record " + file).output ==
          "error: --record-split: '10' has no unit; write one of B, KiB, MiB or GiB, as in 64KiB\n");
    CHECK(!fs::exists(file));
  }

  TEST_CASE("a file in the place of a later part is found before the run, and left alone") {
    const TemporaryFolder folder;
    for (const char* name : {"r.2.mcap", "r.17.mcap", "r.3.mcap"}) {
      const std::string later = folder.write(name, "somebody's notes");
      if (std::string(name) == "r.3.mcap") {  // nor may it be a folder
        fs::remove(later);
        fs::create_directory(later);
      }
      const auto run =
          command::run_jarol("run " + graph_in(folder) + " --for 30s --record " + folder / "r.mcap" + split);
      CHECK(run.exit_code == 2);
      CHECK(run.output ==
            "error: can't write '" + later + "': it is there and no recording; choose another file, or remove it\n");
      CHECK((fs::is_directory(later) || command::content(later) == "somebody's notes"));
      CHECK(!fs::exists(folder / "r.mcap"));
      fs::remove(later);
    }
    // these are nobody's parts, nor is an old part anything to keep
    for (const char* name : {"r.x.mcap", "r.1.mcap", "r.2.csv", "q.2.mcap", "r.02.mcap", "r.2.mcap"})
      folder.write(name, std::string(name) == "r.2.mcap" ? "" : "somebody's notes");
    record(folder, "r.mcap", split);
    CHECK(command::content(folder / "r.02.mcap") == "somebody's notes");
  }

  TEST_CASE("where the name of a part is taken on the way, the one before it goes on, and nothing is lost") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", second = folder / "r.2.mcap";
    const auto run =
        command::run_jarol("run " + graph_in(folder) + " --for 30s --record " + file + split + " --trace " + second);
    CHECK(run.exit_code == 0);
    CHECK(has(run.output, "note: '" + file + "' went on beyond the size of --record-split: can't write '" + second +
                              "': another run writes it\n"));
    CHECK(fs::file_size(file) > (std::uintmax_t{3} << 20));
    CHECK(command::content(second).starts_with("time,"));
    CHECK(json_report("log info " + file)["whole"] == true);
    CHECK(command::run_jarol("replay " + file).exit_code == 0);
  }
}
