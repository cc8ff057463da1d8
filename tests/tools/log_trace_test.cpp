// A recording as trace events, read by a JSON parser and counted against the recording. What the events have to hold is
// from the description of the Trace Event Format.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "runtime/record/recorded_run.h"
#include "runtime/record/recording_writer.h"
#include "runtime/run/input_log.h"
#include "tests/graph/graph_of.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using command::TemporaryFolder;
using nlohmann::json;

// Every event has what the format asks of its kind; names of tracks stand before their events.
json read_trace(const std::string& text) {
  json trace = json::parse(text);
  std::map<std::pair<int, int>, std::string> tracks;
  for (json& event : trace.at("traceEvents")) {
    CAPTURE(event);
    const std::string kind = event.at("ph");
    const std::pair track(event.at("pid").get<int>(), event.at("tid").get<int>());
    if (kind == "M") {
      CHECK(event.at("args").size() == 1);
      if (event.at("name") == "thread_name") tracks[track] = event.at("args").at("name");
      continue;
    }
    CHECK((kind == "X" || kind == "i"));
    CHECK(event.at("cat").is_string());
    CHECK(event.at("name").is_string());
    CHECK(event.at("ts").get<double>() >= 0);
    if (kind == "X") CHECK(event.at("dur").get<double>() >= 0);
    if (kind == "i") CHECK((event.at("s") == "t" || event.at("s") == "g"));
    const auto name = tracks.find(track);
    CHECK((track.second == 0 || name != tracks.end()));
    event["track"] = name == tracks.end() ? "" : name->second;
  }
  return trace;
}

json trace_of(const std::string& file) {
  const auto trace = command::run_jarol("log trace " + file, "");
  CHECK(trace.exit_code == 0);
  return read_trace(trace.output);
}

// By category and track.
std::map<std::string, std::uint64_t> counts(const json& trace) {
  std::map<std::string, std::uint64_t> counted;
  for (const json& event : trace.at("traceEvents"))
    if (event.at("ph") != "M")
      ++counted[event.at("cat").get<std::string>() + " " + event.at("track").get<std::string>()];
  return counted;
}

const json& find(const json& trace, const std::string& name) {
  for (const json& event : trace.at("traceEvents"))
    if (event.at("name") == name) return event;
  static const json none;
  FAIL(name);
  return none;
}
}  // namespace

TEST_SUITE("tools/log_trace") {
  TEST_CASE("each release is an event on the track of its task, a span where it has a LET, as many as ran") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", out = folder / "trace.json";
    REQUIRE(command::run_jarol("run specs/counting.yaml --for 1990ms --record " + file).exit_code == 0);
    const json trace = trace_of(file);
    auto counted = counts(trace);
    CHECK(counted ==
          std::map<std::string, std::uint64_t>{
              {"let loop", 40}, {"let slow", 100}, {"release add", 99}, {"release count", 199}, {"release sum", 99}});
    std::uint64_t all = 0;
    for (const auto& [name, count] : counted) all += count;
    const RecordedRun run(file);
    CHECK(all == run.end()->activations);
    // what a data-flow task published is what it was released for; of a LET the last is still under way
    for (const char* task : {"add", "count", "sum"})
      CHECK(counted["release " + std::string(task)] == run.recording().find(task + std::string(".out"))->messages);
    CHECK(counted["let slow"] == run.recording().find("slow.out")->messages + 1);
    const json& span = find(trace, "slow 1");
    CHECK(span.at("ts") == 20'000);
    CHECK(span.at("dur") == 15'000);
    CHECK(trace.at("otherData").at("schema") == "jarol.log_trace/1");
    CHECK(trace.at("otherData").at("graph") == "counting");
    // the same as a file, which appears whole
    CHECK(command::run_jarol("log trace " + file + " -o " + out).output == "");
    std::ifstream written(out);
    CHECK(json::parse(written) == json::parse(command::run_jarol("log trace " + file, "").output));
  }

  TEST_CASE("each fault is marked at the instant of the outputs that it lacks") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", graph = folder.write("g.yaml", R"(graph: "g \"<"
fault_limit: 100%
tasks:
  a: {type: Counter, period: 10ms}
  w: {type: Window, period: 10ms, let: 5ms, heap: 96B, on_fault: hold, parameters: {length: 100}}
connections: [a.out -> w.in]
)");
    REQUIRE(command::run_jarol("run " + graph + " --for 200ms --record " + file).exit_code == 0);
    const json trace = trace_of(file);
    auto counted = counts(trace);
    const RecordedRun run(file);
    CHECK(run.end()->faults > 3);
    CHECK(counted["fault w"] == run.end()->faults);
    CHECK(counted["let w"] == 20);
    CHECK(run.recording().find("w.out")->messages + counted["fault w"] == 20);
    CHECK(trace.at("otherData").at("graph") == "g \"<");
    for (const json& event : trace.at("traceEvents"))
      if (event.value("cat", "") == "fault")
        CHECK(event.at("ts").get<double>() == 10'000 * event.at("args").at("activation").get<double>() + 5'000);
  }

  TEST_CASE("a release that a skip left out is marked as such, and no activation") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", graph = folder.write("g.yaml", R"(graph: g
fault_limit: 100%
tasks:
  a: {type: Counter, period: 10ms}
  w: {type: Window, period: 10ms, let: 5ms, heap: 96B, on_fault: skip, parameters: {length: 100}}
connections: [a.out -> w.in]
)");
    REQUIRE(command::run_jarol("run " + graph + " --for 195ms --record " + file).exit_code == 0);
    const json trace = trace_of(file);
    auto counted = counts(trace);
    const RecordedRun run(file);
    CHECK(counted["skip w"] > 3);
    CHECK(counted["skip w"] + counted["let w"] == 20);
    CHECK(counted["let w"] + counted["release a"] == run.end()->activations);
    for (const json& event : trace.at("traceEvents")) {
      if (event.value("cat", "") != "fault") continue;
      const int next = event.at("args").at("activation").get<int>() + 1;
      CHECK(find(trace, "w " + std::to_string(next) + " is skipped").at("ts") == 10'000 * next);
    }
  }

  TEST_CASE("what was late stands on a track of physical time, as long as it took, also after years") {
    const TemporaryFolder folder;
    const std::string text = R"(graph: g
tasks:
  a: {type: Counter, period: 10ms}
  b: {type: Relay, period: 10ms, let: 10ms}
connections: [a.out -> b.in]
)",
                      path = folder.write("g.yaml", text), file = folder / "r.mcap";
    const Graph graph = tests::graph_of(text);
    RecordingWriter writer(file, {.graph = "g", .file = path, .overrides = {}, .clock = "real", .what = "inputs"},
                           {{path, text}}, graph);
    writer.open();
    InputLog log(graph, writer.recorder());
    log.late(1, 2, 12'345'678ns, 30ms);
    log.left_out(1, 3, 30ms);
    log.late(0, 4, {}, 50ms);
    writer.close({.covered = 100'000'000, .simulated = 100'000'000, .activations = 19, .instants = 10, .faults = 3});
    const json trace = trace_of(file);
    auto counted = counts(trace);
    CHECK(counted["let b"] == 9);
    CHECK(counted["release a"] == 10);
    // in logical time, where it has no LET as it did not run, and in physical time
    CHECK(counted["skip b"] == 1);
    CHECK(counted["miss b"] == 2);
    for (const json& event : trace.at("traceEvents")) CHECK(event.at("name") != "b 3");
    CHECK(counted["miss a"] == 1);
    const json& late = find(trace, "b 2 is late");
    CHECK(late.at("pid") == 2);
    CHECK(late.at("ts") == 20'000);
    CHECK(late.at("dur").get<double>() == doctest::Approx(12'345.678).scale(0).epsilon(1e-12));
    CHECK(find(trace, "b 3 is left out").at("ts") == 30'000);
    CHECK(find(trace, "a 4 has not ended").at("ts") == 50'000);
    CHECK(trace.at("otherData").at("clock") == "real");
    CHECK(command::run_jarol("log cat " + file + " --topic jarol/misses").output ==
          "0.03 jarol/misses activation=2 ended_after=12345678 task=b left_out=0\n"
          "0.03 jarol/misses activation=3 ended_after=-1 task=b left_out=1\n"
          "0.05 jarol/misses activation=4 ended_after=-1 task=a left_out=0\n");
  }

  TEST_CASE("what was late by --execution has named tracks, too") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", times = folder.write("times.yaml", "a: 10us\nw: [10us, 25ms]\n"),
                      graph = folder.write("g.yaml", R"(graph: g
fault_limit: 100%
tasks:
  a: {type: Counter, period: 10ms, wcet: 10us, on_fault: hold}
  w: {type: Relay, period: 10ms, let: 10ms, wcet: 30ms, on_fault: hold}
connections: [a.out -> w.in]
)");
    REQUIRE(command::run_jarol("run " + graph + " --for 100ms --execution " + times + " --record " + file).exit_code ==
            0);
    const json trace = trace_of(file);
    CHECK(counts(trace)["miss w"] > 0);
    CHECK(find(trace, "w 1 has not ended").at("pid") == 2);
  }

  TEST_CASE("options of other commands are refused, and plugins are loaded only where the user names the graph") {
    CHECK(command::run_jarol("log trace a --json", "2>&1 >/dev/null").output ==
          "error: --json belongs to info, verify and diff\n");
    CHECK(command::run_jarol("log trace a --topic x").output == "error: --topic belongs to cat, csv and diff\n");
    CHECK(command::run_jarol("log cat a -o x").output == "error: --out belongs to trace and report\n");
    const TemporaryFolder folder;
    const std::string plugins = std::filesystem::absolute(JAROL_PLUGIN_FOLDER), file = folder / "r.mcap",
                      graph =
                          folder.write("g.yaml", "graph: g\nplugins: [" + plugins +
                                                     "/low_pass.so]\ntasks:\n  c: {type: Counter, period: 10ms}\n  l: "
                                                     "{type: LowPass, period: 10ms}\nconnections: [c.out -> l.in]\n");
    REQUIRE(command::run_jarol("run " + graph + " --for 100ms --record " + file).exit_code == 0);
    const auto refused = command::run_jarol("log trace " + file);
    CHECK(refused.exit_code == 2);
    CAPTURE(refused.output);
    CHECK(refused.output.find("name it yourself: jarol log trace FILE GRAPH") != std::string::npos);
    CHECK(counts(read_trace(
              command::run_jarol("log trace " + file + " " + graph, "2>/dev/null").output))["release l"] == 10);
  }
}
