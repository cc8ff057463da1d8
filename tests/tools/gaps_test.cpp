// Recordings that lack what came faster than the disk took it: who looks into one is told, and nothing is made of what
// is not there.
#include <doctest/doctest.h>

#include "graph/values/type_of.h"
#include "runtime/record/cdr.h"
#include "runtime/record/recording.h"
#include "runtime/record/recording_format.h"
#include "tests/tools/reports.h"
#include "tests/tools/rewrite_recording.h"
#include "tests/tools/run_command.h"

namespace {
using namespace std::chrono_literals;
using namespace jarol;
using command::has;
using command::TemporaryFolder;

// As a writer that is held up leaves it: without the values of an output from 0.3 s to 0.5 s, and with a gap that says
// so.
void drop(const std::string& from, const std::string& to, const std::string& output) {
  const Recording recording(from);
  const std::uint16_t channel = recording.find(output)->channel.id;
  const std::uint16_t gaps = recording.find(std::string(topics::gaps))->channel.id;
  Gap gap;
  command::rewrite_recording(from, to, [&](const mcap::Message& message, mcap::Chunk& chunk) {
    if (message.channel != channel || message.time < 300ms || message.time > 500ms)
      return void(command::copy_message(message, chunk));
    if (gap.values++ == 0) gap.from = message.time.count();
    gap.to = message.time.count();
    if (message.time < 500ms) return;
    const CdrEncoder encoder(type_of<Gap>());
    encoder.encode(&gap, chunk.add_message(gaps, 0, message.time, encoder.size(&gap)));
  });
}
}  // namespace

TEST_SUITE("tools/gaps") {
  TEST_CASE("what a recording lacks is said by all that look into it, and tasks by themselves are not run on it") {
    const TemporaryFolder folder;
    const std::string whole = folder / "whole.mcap", file = folder / "r.mcap",
                      graph = folder.write("g.yaml", R"(graph: g
tasks:
  count: {type: Counter, period: 100ms}
  sum: {type: Accumulate, period: 100ms}
connections: [count.out -> sum.in]
)");
    REQUIRE(command::run_jarol("run " + graph + " --for 1s --record " + whole).exit_code == 0);
    drop(whole, file, "count.out");
    CHECK(command::run_jarol("log verify " + file).exit_code == 0);
    const std::string note =
        "note: '" + file +
        "' lacks 3 published values from 0.3 s to 0.5 s, which came faster than the disk took them\n";

    // the values that are there are the same
    const auto replay = command::run_jarol("replay " + file);
    CAPTURE(replay.output);
    CHECK(replay.exit_code == 0);
    CHECK(has(replay.output, "  same        as the run on the virtual clock, 17 values compared\n"));
    CHECK(has(replay.output, note));
    CHECK(has(command::run_jarol("log info " + file).output, note));
    CHECK(command::json_report("log info " + file)["gaps"] ==
          nlohmann::json::parse(R"([{"from_ns":300000000,"to_ns":500000000,"values":3}])"));
    CHECK(command::json_report("log info " + whole)["gaps"].empty());
    const auto only = command::run_jarol("replay " + file + " --only sum");
    CHECK(only.exit_code == 2);
    CHECK(only.output == note +
                             "error: --only: the recording lacks published values that these tasks may have read, from "
                             "0.3 s on, as they "
                             "came faster than the disk took them; leave --only out\n");
    CHECK(command::run_jarol("replay " + whole + " --only sum").exit_code == 0);

    const auto csv = command::run_jarol("log csv " + file);
    CHECK(csv.exit_code == 0);
    CHECK(has(csv.output, note));
    CHECK_FALSE(has(command::run_jarol("log csv " + whole).output, "lacks"));
    const auto diff = command::run_jarol("log diff " + whole + " " + file);
    CAPTURE(diff.output);
    CHECK(has(diff.output, note));
    CHECK(has(diff.output, "DIFFERENT, 17 values compared\n"));
    CHECK(has(diff.output, "  first       count.out at 0.3 s: was published, is nothing\n"));
  }
}
