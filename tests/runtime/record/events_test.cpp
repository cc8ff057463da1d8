// What those who look on at a run see beside publications.
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>

#include "runtime/execute/log_end.h"
#include "runtime/record/recorded_run.h"
#include "runtime/record/recording_writer.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Lines of publications and events, of one output or of all.
class Seen : public tests::TraceLines {
 public:
  explicit Seen(const Graph& graph, std::optional<std::uint32_t> only = {}) : TraceLines(graph), only_(only) {}
  bool wants(std::uint32_t output) const override { return !only_ || output == *only_; }
  void take_event(const RunEvent& event) override {
    REQUIRE(event.kind == RunEvent::Kind::fault);
    lines.push_back(duration_text(event.instant) + " task " + std::to_string(event.task) + " activation " +
                    std::to_string(event.activation) + ": " + std::string(event.cause));
  }

 private:
  std::optional<std::uint32_t> only_;
};

const char* const text = R"(graph: t
tasks:
  a: {type: Counter, period: 10ms}
  w: {type: Window, period: 10ms, heap: 96B, on_fault: hold, parameters: {length: 100}}
connections: [a.out -> w.in]
)";

Report run_into(const Graph& graph, std::vector<RecordSink*> sinks, Duration end) {
  Recorder recorder(std::move(sinks));
  Executor executor(graph, {}, {.recorder = &recorder});
  executor.run_until(end);
  recorder.close();
  return executor.report();
}
}  // namespace

TEST_SUITE("runtime/events") {
  TEST_CASE("faults come between publications, in the order in which they took place, with what the report says") {
    const Graph graph = tests::graph_of(text);
    Seen seen(graph);
    const Report report = run_into(graph, {&seen}, 100ms);
    REQUIRE(report.fault_count > 1);
    const Fault& first = report.faults.front();
    const std::string line =
        duration_text(first.instant) + " task 1 activation " + std::to_string(first.activation) + ": " + first.cause;
    const auto at = std::find(seen.lines.begin(), seen.lines.end(), line);
    REQUIRE(at != seen.lines.end());
    CHECK(*(at - 1) == duration_text(first.instant) + " a.out=" + std::to_string(first.activation));
    CHECK(std::count_if(seen.lines.begin(), seen.lines.end(), [](const std::string& l) {
            return l.find(" task 1 ") != std::string::npos;
          }) == static_cast<std::ptrdiff_t>(report.fault_count));
  }

  TEST_CASE("a recording has each fault of a run, and what is published before it and after it") {
    const Graph graph = tests::graph_of(text);
    const std::string path =
        std::filesystem::temp_directory_path() / ("events_" + std::to_string(::getpid()) + ".mcap");
    RecordingWriter writer(path, {.graph = "t", .file = "", .overrides = {}, .clock = "virtual", .what = "all"}, {},
                           graph);
    writer.open();
    Recorder recorder({writer.publications()});
    Executor executor(graph, {}, {.recorder = &recorder, .log = writer.recorder()});
    executor.run_until(100ms);
    recorder.close();
    const Report& report = executor.report();
    writer.close(log_end_of(report));
    const RecordedRun run(path);
    std::filesystem::remove(path);
    REQUIRE(report.fault_count > 1);
    CHECK(run.gaps().empty());
    CHECK(run.recording().find("jarol/events")->messages == report.fault_count);
    CHECK(run.recording().find("a.out")->messages == 10);
  }

  TEST_CASE("what no sink wants is not recorded, and what one wants comes to all") {
    const Graph graph = tests::graph_of(R"(graph: t
tasks:
  a: {type: Counter, period: 10ms}
  b: {type: Counter, period: 10ms}
  c: {type: Counter, period: 10ms}
)");
    Seen a(graph, 0), b(graph, 1);
    const Report report = run_into(graph, {&a, &b}, 20ms);
    CHECK(a.lines == std::vector<std::string>{"0ns a.out=0", "0ns b.out=0", "10ms a.out=1", "10ms b.out=1"});
    CHECK(b.lines == a.lines);
    CHECK(report.digest == run_into(graph, {}, 20ms).digest);
  }
}
