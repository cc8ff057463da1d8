// Recordings of runs whose recorder has lost values, or whose stream of published values has failed: they are not
// whole, and say from when on.
#include <doctest/doctest.h>

#include <atomic>
#include <filesystem>
#include <stdexcept>

#include "graph/text/errors.h"
#include "runtime/record/recorded_run.h"
#include "runtime/record/recording_writer.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Stands still until it is let go.
struct Stalled : RecordSink {
  void take(Duration, std::uint32_t, const void*) override {
    stands = true;
    stands.notify_all();
    free.wait(false);
  }
  void finish() override {}
  void let_go() {
    free = true;
    free.notify_all();
  }
  std::atomic<bool> stands{false}, free{false};
};

// Hands everything on until that instant, and throws there.
struct FailsAt : RecordSink {
  FailsAt(RecordSink& next, Duration instant) : to(next), at(instant) {}
  bool wants(std::uint32_t output) const override { return to.wants(output); }
  void take(Duration instant, std::uint32_t output, const void* value) override {
    to.take(instant, output, value);
    if (instant == at) throw std::runtime_error("there is no room");
  }
  void finish() override { to.finish(); }
  RecordSink& to;
  Duration at;
};

// A recording on the real clock of an output with a value each nanosecond.
struct LossyRecording {
  explicit LossyRecording(const std::string& what = "all")
      : path(std::filesystem::temp_directory_path() / ("lost_values_" + std::to_string(::getpid()) + ".mcap")),
        graph(tests::graph_of("graph: t\ntasks: {a: {type: Counter, period: 1ms}, b: {type: Counter, period: 1ms}}\n")),
        writer(path, {.graph = "t", .file = "", .overrides = {}, .clock = "real", .what = what}, {}, graph) {
    writer.open();
  }
  ~LossyRecording() { std::filesystem::remove(path); }
  static void append(Recorder& recorder, std::int64_t count, std::int64_t first = 0) {
    for (std::int64_t i = first; i < count; ++i) {
      const auto number = static_cast<double>(i);
      recorder.append(Duration(i), 0, &number, sizeof number);
    }
  }
  RecordedRun read(std::int64_t covered) {
    writer.close({.covered = covered, .simulated = covered});
    return RecordedRun(path);
  }
  static std::uint64_t values_in(const RecordedRun& run) { return run.recording().find("a.out")->messages; }

  const std::string path;
  const Graph graph;
  RecordingWriter writer;
};

constexpr std::int64_t lost_count = 200'000;
}  // namespace

TEST_SUITE("runtime/lost_values") {
  TEST_CASE("a recording goes on for as long as another sink stalls as it has memory for, and lacks only the rest") {
    LossyRecording recording;
    Stalled stalled;
    Recorder recorder({&stalled, recording.writer.publications()});
    recorder.expect(outputs_of(recording.graph));
    recorder.never_wait();
    LossyRecording::append(recorder, 1);
    recorder.hand_on();
    stalled.stands.wait(false);
    LossyRecording::append(recorder, lost_count, 1);
    stalled.let_go();
    CHECK_THROWS_AS(recorder.close(), InputError);
    const RecordedRun run = recording.read(lost_count);
    REQUIRE(run.gaps().size() == 1);
    const Gap gap = run.gaps()[0];
    constexpr std::int64_t min_from = 15 * (256 << 10) / 50;  // of pieces of so many bytes
    CHECK(gap.from > min_from);
    CHECK(gap.to - gap.from + 1 == static_cast<std::int64_t>(gap.values));
    CHECK(LossyRecording::values_in(run) + gap.values == lost_count);
  }

  TEST_CASE("what a recorder that puts values in order loses as another sink stalls is a gap in the recording") {
    LossyRecording recording;
    Stalled stalled;
    Recorder recorder({&stalled, recording.writer.publications()});
    recorder.expect(outputs_of(recording.graph));
    recorder.put_in_order(0ns);
    recorder.never_wait();
    LossyRecording::append(recorder, lost_count);
    stalled.let_go();
    CHECK_THROWS_WITH_AS(recorder.close(),
                         "values could not be written as fast as they came; from 76454ns on they are lost", InputError);
    const RecordedRun run = recording.read(lost_count);
    REQUIRE(run.gaps().size() == 1);
    const Gap gap = run.gaps()[0];
    CHECK(gap.from == 76454);
    CHECK(gap.to == lost_count - 1);
    CHECK(gap.values == lost_count - 76454);
    CHECK(LossyRecording::values_in(run) == 76454);
  }

  TEST_CASE("what is lost and not to be recorded is no gap in the recording") {
    LossyRecording recording("b.out");
    Stalled stalled;
    Recorder recorder({&stalled, recording.writer.publications()});
    recorder.expect(outputs_of(recording.graph));
    recorder.never_wait();
    LossyRecording::append(recorder, lost_count);
    stalled.let_go();
    CHECK_THROWS_AS(recorder.close(), InputError);
    CHECK(recording.read(lost_count).gaps().empty());
  }

  TEST_CASE("where the stream of published values fails all that it held is a gap up to the end of the run") {
    LossyRecording recording;
    FailsAt failing(*recording.writer.publications(), 500ns);
    Recorder recorder({&failing});
    recorder.expect(outputs_of(recording.graph));
    LossyRecording::append(recorder, 1000);
    CHECK_THROWS_WITH_AS(recorder.close(), "there is no room", std::runtime_error);
    const RecordedRun run = recording.read(1000);
    REQUIRE(run.gaps().size() == 1);
    const Gap gap = run.gaps()[0];
    CHECK(gap.from == 0);
    CHECK(gap.to == 1000);
    CHECK(gap.values == 501);
    CHECK(LossyRecording::values_in(run) == 0);
  }
}
