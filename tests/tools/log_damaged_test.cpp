// Recordings that are damaged, or joined, as jarol log shows them.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "graph/language/quantities.h"
#include "runtime/record/recorded_run.h"
#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::content;
using command::has;
using command::TemporaryFolder;
}  // namespace

TEST_SUITE("tools/log_damaged") {
  TEST_CASE(
      "of a recording with a damaged chunk each command shows what there is before, says so, and exits with 1, a "
      "replay with 3") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", graph = folder.write("g.yaml", R"(graph: g
tasks: {count: {type: Counter, period: 1ms}}
)");
    REQUIRE(
        command::run_jarol("run " + graph + " --for 20s --record " + file + " --record-compression none").exit_code ==
        0);
    std::string bytes = content(file);
    // the last with published values
    const jarol::Recording recording(file);
    const std::uint16_t published = recording.find("count.out")->channel.id;
    std::uint64_t offset = 0;
    for (const jarol::ReadPlace& chunk : recording.chunks())
      if (chunk.min_channel <= published && published <= chunk.max_channel) offset = chunk.offset;
    const std::string at = std::to_string(offset), damaged = folder / "damaged";
    bytes[offset + 1000] ^= 1;
    folder.write("damaged", bytes);
    const auto errors = [&](const std::string& words) {
      const auto result = command::run_jarol("log " + words, "2>&1 >" + (folder / "out"));
      CHECK(result.exit_code == 1);
      return result.output;
    };
    const std::string by_index =
        "error: '" + damaged + "' is damaged: at byte " + at + " there is a chunk whose check sum is another\n";
    const std::string on_the_way =
        "error: '" + damaged + "' is damaged at byte " + at + ": this is what there is before\n";
    CHECK(errors("cat " + damaged) == by_index);
    CHECK(errors("csv " + damaged) == by_index);
    CHECK(errors("diff " + file + " " + damaged) == by_index);
    CHECK(errors("trace " + damaged) == on_the_way);
    CHECK(nlohmann::json::parse(content(folder / "out"))["otherData"]["graph"] == "g");
    CHECK(errors("report " + damaged + " -o " + (folder / "r.html")) == on_the_way);
    CHECK(has(content(folder / "r.html"), "</html>"));
    const auto replay = command::run_jarol("replay " + damaged, "2>&1 >/dev/null");
    CHECK(replay.exit_code == 3);
    CHECK(replay.output == "error: '" + damaged + "' is damaged at byte " + at + ", before " +
                               jarol::seconds_text(jarol::RecordedRun(damaged).covered()) +
                               " s it is whole; how the run ended is not known\n");
  }

  TEST_CASE("of recordings that were joined the first is shown, and that more follows is said") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", both = folder / "both.mcap";
    REQUIRE(command::run_jarol("run specs/counting.yaml --for 2s --record " + file).exit_code == 0);
    const std::string bytes = content(file), size = std::to_string(bytes.size());
    folder.write("both.mcap", bytes + bytes);
    const std::string note = "note: '" + both + "' goes on for " + size +
                             " bytes after its end; what was recorded is: head -c " + size + " " + both + "\n";
    for (const std::string command : {"info", "info --json", "cat", "csv"}) {
      CAPTURE(command);
      const auto shown = command::run_jarol("log " + command + " " + both, "2>&1 >" + (folder / "out"));
      CHECK(shown.exit_code == 0);
      CHECK(shown.output == note);
    }
    const std::string digest = "  digest      0x";
    const std::string info = command::run_jarol("log info " + both, "2>/dev/null").output;
    CHECK(info.starts_with("counting: 2 s on the virtual clock, "));
    CHECK(
        has(info, command::run_jarol("log info " + file)
                      .output.substr(command::run_jarol("log info " + file).output.find(digest), digest.size() + 16)));
  }
}
