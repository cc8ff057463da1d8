// One bit of one value that came from outside, or was published, is changed in a recording: both who replays it and who
// compares it with the one that it was find it, by instant and field.
#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#include "runtime/record/recording.h"
#include "tests/tools/reports.h"
#include "tests/tools/rewrite_recording.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using command::has;
using command::TemporaryFolder;

// A message of a topic, counted from 0, and a bit of its data.
struct Place {
  std::string topic;
  std::uint64_t message = 0;
  std::size_t byte = 0;
  int bit = 0;
};

struct Changed {
  std::int64_t instant = 0;
  double before = 0, after = 0;  // of the eight bytes around that bit
};

// Copies a recording with that one bit changed; all its check sums are right.
Changed change(const std::string& from, const std::string& to, const Place& place) {
  const Recording recording(from);
  const std::uint16_t channel = recording.find(place.topic)->channel.id;
  Changed changed;
  std::uint64_t seen = 0;
  command::rewrite_recording(from, to, [&](const mcap::Message& message, mcap::Chunk& chunk) {
    std::byte* const data = command::copy_message(message, chunk);
    if (message.channel != channel || seen++ != place.message) return;
    std::byte* const number = data + 4 + (place.byte - 4) / 8 * 8;
    std::memcpy(&changed.before, number, sizeof(double));
    data[place.byte] ^= std::byte{1} << place.bit;
    std::memcpy(&changed.after, number, sizeof(double));
    changed.instant = message.time.count();
  });
  return changed;
}

std::string bits_of(double number) {
  char text[20];
  std::snprintf(text, sizeof text, "0x%016lx", std::bit_cast<std::uint64_t>(number));
  return text;
}
}  // namespace

TEST_SUITE("tools/changed_input") {
  TEST_CASE("one changed bit of one input is found and named by instant and field") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", other = folder / "changed.mcap";
    REQUIRE(command::run_jarol("run specs/exolauv.yaml --for 10s --set expect=nothing --record " + file).exit_code ==
            0);
    CHECK(command::run_jarol("replay " + file).exit_code == 0);
    // the third number of what the submarine reported, after four bytes in front
    const std::size_t third = 4 + 2 * 8;
    const std::string topic = "jarol/taken/from_dune";
    for (const Place& place : {Place{topic, 0, third, 0}, Place{topic, 100, third + 3, 5},
                               Place{topic, 57, third + 6, 7}, Place{topic, 199, third + 5, 2}}) {
      const Changed changed = change(file, other, place);
      CAPTURE(place.message);
      CHECK(command::run_jarol("log verify " + other).exit_code == 0);
      char instant[32];
      std::snprintf(instant, sizeof instant, "%g s", static_cast<double>(changed.instant) * 1e-9);
      const std::string values = " at " + std::string(instant) + ": was ";
      const auto replay = command::run_jarol("replay " + other);
      CAPTURE(replay.output);
      CHECK(replay.exit_code == 1);
      CHECK(has(replay.output, "  first       from_dune.pressure.value" + values));
      CHECK(has(replay.output, "(" + bits_of(changed.before) + "), is "));
      CHECK(has(replay.output, "(" + bits_of(changed.after) + ")\n"));
      const auto diff = command::run_jarol("log diff " + file + " " + other);
      CAPTURE(diff.output);
      CHECK(diff.exit_code == 1);
      CHECK(has(diff.output, "  first       jarol/taken/from_dune.pressure.value" + values));
      CHECK(has(diff.output, "(" + bits_of(changed.after) + ")\n"));
    }
  }

  TEST_CASE("a changed value that was published is where a replay diverges, though all digests are the run's") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", other = folder / "changed.mcap";
    REQUIRE(command::run_jarol("run specs/counting.yaml --for 5s --record " + file).exit_code == 0);
    const Changed changed = change(file, other, {.topic = "count.out", .message = 250, .byte = 10, .bit = 4});
    CHECK(changed.instant == 2'500'000'000);
    const auto replay = command::run_jarol("replay " + other);
    CAPTURE(replay.output);
    CHECK(replay.exit_code == 1);
    CHECK(has(replay.output, "  DIVERGED    from the run on the virtual clock after 2.5 s\n"));
    CHECK(has(replay.output, "  first       count.out at 2.5 s: was "));
    CHECK(has(command::run_jarol("replay --json " + other, "").output, "\"same_until_ns\":2500000000"));
  }
}
