// A run from begin to end, its recording and its replay, as a program has them.
#include <doctest/doctest.h>

#include <filesystem>

#include "distributers/session/replayer.h"
#include "distributers/session/runner.h"
#include "distributers/session/session.h"
#include "graph/text/errors.h"
#include "tasks/values/lauv.h"
#include "tests/distributers/all_parts.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

const distributers::Registries& all_built_in() { return tests::all_parts_with<>(); }

std::shared_ptr<const Source> counting_text() {
  return std::make_shared<const Source>(Source{"counting.yaml", R"(
graph: counting
timing: {period: 10ms}
tasks: {count: {type: Counter, wcet: 1ms}}
)"});
}

Loaded load_counting() { return load_graph(counting_text(), all_built_in(), {}, 0); }

struct RecordingFile {
  RecordingFile() { std::filesystem::remove(path); }
  ~RecordingFile() { std::filesystem::remove(path); }
  const std::string path = std::filesystem::temp_directory_path() / "jarol_runner_test.mcap";
};
}  // namespace

TEST_SUITE("distributers/session/runner") {
  TEST_CASE("a run is recorded, and its replay is the same to the last value") {
    const RecordingFile file;
    Runner runner(load_counting(), {.end = 1s, .recording = {.file = file.path}});
    const RunOutcome outcome = runner.run();
    CHECK(outcome.end.ending.reason == "the run was over");
    CHECK(outcome.simulated == 1s);
    CHECK(outcome.report.activations == 100);
    CHECK(outcome.unwritten == "");
    RecordedRun log(file.path);
    Replayer replayer(log, all_built_in());
    const ReplayOutcome again = replayer.run();
    CHECK(again.comparison.evidence == Evidence::same);
    CHECK(again.differences.compared() == 100);
    CHECK(again.run.report.digest == outcome.report.digest);
  }

  TEST_CASE("a run that goes on from a checkpoint is the same run, and its recording can be replayed from there") {
    const RecordingFile file;
    std::optional<Checkpoint> saved{};
    Runner whole(load_counting(),
                 {.end = 1s, .stops = {{"the test", 400ms, [&](Checkpoint c) { saved = c; }, "lost"}}});
    const RunOutcome first = whole.run();
    CHECK(first.unsaved == "");
    REQUIRE(saved);
    Runner rest(load_counting(), {.end = 1s, .recording = {.file = file.path}, .resumed = &*saved});
    const RunOutcome second = rest.run();
    CHECK(second.begun == 400ms);
    CHECK(second.report.digest == first.report.digest);
    RecordedRun log(file.path);
    Replayer replayer(log, all_built_in());
    CHECK(replayer.run().comparison.evidence == Evidence::same);
    CHECK(replayer.begun() == 400ms);
  }

  TEST_CASE("a session that is stepped is recorded, too, and its replay is the same to the last value") {
    const RecordingFile file;
    Session session(all_built_in(), counting_text(), {.execution = "wcet", .recording = {.file = file.path}});
    session.run_until(300ms);
    session.run_until(1s);
    const std::uint64_t digest = session.report().digest;
    CHECK_FALSE(session.finish().is_negative());
    RecordedRun log(file.path);
    Replayer replayer(log, all_built_in());
    const ReplayOutcome again = replayer.run();
    CHECK(again.comparison.evidence == Evidence::same);
    CHECK(again.run.simulated == 1s);
    CHECK(again.run.report.digest == digest);
  }

  TEST_CASE("what a session is fed in place of links is recorded, and fed again by its replay") {
    const RecordingFile file;
    const auto text = std::make_shared<const Source>(Source{"t.yaml", R"(
graph: t
timing: {period: 10ms}
distributers: {dune: {type: LauvVehicle, link: {type: udp, listen: 0}}}
communicators: {motion: {channel: dune.motion}, hand: {type: Actuation, direction: in}}
tasks: {forward: {type: LauvForward, wcet: 1us}}
connections: [motion -> forward.motion, hand -> forward.actuation]
)"});
    Session session(all_built_in(), text, {.fed = {"dune"}, .recording = {.file = file.path}});
    session.run_until(300ms);
    session.feed("motion", tasks::Motion{.z = 3});
    session.run_until(1s);
    const std::uint64_t digest = session.report().digest;
    session.finish();
    RecordedRun log(file.path);
    Replayer replayer(log, all_built_in());
    const ReplayOutcome again = replayer.run();
    CHECK(again.comparison.evidence == Evidence::same);
    CHECK(again.run.report.digest == digest);
  }

  TEST_CASE(
      "what a session that is recorded can't do is refused: to go back, to save on its way, to be fed what no replay "
      "could") {
    const RecordingFile file;
    Session session(all_built_in(), counting_text(), {.recording = {.file = file.path}});
    const Checkpoint begin = session.checkpoint();
    session.run_until(100ms);
    CHECK_THROWS_WITH_AS(
        session.restore(begin),
        "a run that is recorded does not go on from a checkpoint; restore it in a session without .recording",
        CheckpointRefused);
    CHECK_THROWS_WITH_AS(
        Session(all_built_in(), counting_text(), {.recording = {.file = file.path, .checkpoints = 1s}}),
        ".recording.checkpoints belongs to a Runner; a session is saved by checkpoint() where it stands", InputError);
    const auto text = std::make_shared<const Source>(Source{"t.yaml", R"(
graph: t
timing: {period: 10ms}
communicators: {motion: {type: Motion, direction: in}, hand: {type: Actuation, direction: in}}
tasks: {forward: {type: LauvForward, wcet: 1us}}
connections: [motion -> forward.motion, hand -> forward.actuation]
)"});
    CHECK_THROWS_WITH_AS(Session(all_built_in(), text, {.fed = {"*"}, .recording = {.file = file.path}}),
                         ".recording: 'hand' is fed and has no channel, from which a replay would take its values; "
                         "give it one in the graph, as in {channel: dune.motion}",
                         InputError);
  }

  TEST_CASE("with execution times a late task stops the run, and the outcome says which") {
    Runner runner(load_counting(), {.end = 1s, .execution = "wcet"});
    CHECK(runner.run().report.fault_count == 0);
    Loaded late = load_counting();
    late.graph->tasks[0].deadline = 500us;
    Runner stopped(std::move(late), {.end = 1s, .execution = "wcet"});
    const RunOutcome outcome = stopped.run();
    CHECK(outcome.report.faults.front().task == "count");
    CHECK(outcome.end.ending.reason == "a fault ended the run");
  }

  TEST_CASE("the same graph runs on ordinary threads, of whose digest nothing is claimed") {
    Runner runner(load_counting(), {.end = 100ms, .real_clock = true, .threads = true});
    const RunOutcome outcome = runner.run();
    CHECK(outcome.threads != nullptr);
    CHECK(outcome.in_real_time());
    CHECK(outcome.end.ending.reason == "the run was over");
    CHECK(outcome.report.activations > 0);
  }

  TEST_CASE("what a run can't do is refused before it begins") {
    CHECK_THROWS_WITH_AS(Runner(load_counting(), {.end = 1s, .workers = 65}), "a run has 1 to 64 workers, not 65",
                         NotExecutable);
    CHECK_THROWS_WITH_AS(Runner(load_counting(), {.end = 1s, .real_clock = true, .workers = 2}),
                         ".workers belongs to the virtual clock; the real one goes by 'platform'", NotExecutable);
    CHECK_THROWS_WITH_AS(
        Runner(load_counting(), {.end = 1s, .stops = {{".stops", 2s, [](const Checkpoint&) {}, "lost"}}}),
        ".stops: the run ends at 1 s, before 2 s", InputError);
  }
}
