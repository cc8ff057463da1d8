// A whole run in a program, recorded and replayed: what jarol run and jarol replay do.
#include <doctest/doctest.h>
#include <jarol/runner.h>

#include <filesystem>
#include <optional>
#include <string>

using namespace std::chrono_literals;

namespace {
struct RecordingFile {
  RecordingFile() { std::filesystem::remove(path); }
  ~RecordingFile() { std::filesystem::remove(path); }
  const std::string path = (std::filesystem::temp_directory_path() / "jarol_consumer.mcap").string();
};
}  // namespace

TEST_CASE("a run is recorded, and its replay is the same to the last value") {
  const RecordingFile file;
  std::uint64_t digest = 0;
  {
    const jarol::SourceSet sources;
    jarol::Runner runner(jarol::load(SPECS "/exolauv.yaml", {}, 3),
                         {.end = 5s, .seed = 3, .recording = {.file = file.path, .sources = &sources}});
    const jarol::RunOutcome outcome = runner.run();
    CHECK(outcome.end.ending.reason == "the run was over");
    CHECK(outcome.simulated == 5s);
    CHECK(outcome.unwritten == "");
    CHECK(outcome.true_states.size() == 1);
    digest = outcome.report.digest;
  }
  jarol::RecordedRun log(file.path);
  CHECK(log.header().seed == 3);
  jarol::Replayer replayer(log, jarol::built_in());
  const jarol::ReplayOutcome replay = replayer.run();
  CHECK(replay.comparison.evidence == jarol::Evidence::same);
  CHECK(replay.run.report.digest == digest);
  CHECK(replay.differences.compared() > 1000);
  CHECK(!replay.differences.first());
}

TEST_CASE("with another gain a replay diverges, and what is first otherwise has a name") {
  const RecordingFile file;
  jarol::Runner(jarol::load(SPECS "/exolauv.yaml"), {.end = 5s, .recording = {.file = file.path}}).run();
  jarol::RecordedRun log(file.path);
  jarol::Replayer replayer(log, jarol::built_in(),
                           {.file = SPECS "/exolauv.yaml", .overrides = {"", {"tasks.depth.parameters.kp=0.2"}}});
  const jarol::ReplayOutcome replay = replayer.run();
  CHECK(replay.comparison.evidence == jarol::Evidence::diverged);
  CHECK(replay.differences.first()->output == "depth.moment");
}

TEST_CASE("a run goes on from where another one was saved, to the same digest") {
  const jarol::Overrides overrides;
  std::optional<jarol::Checkpoint> saved;
  jarol::Runner whole(
      jarol::load(SPECS "/exolauv.yaml"),
      {.end = 5s,
       .stops = {{"the test", 2s, [&](jarol::Checkpoint checkpoint) { saved = std::move(checkpoint); }, "lost"}}});
  const auto digest = whole.run().report.digest;
  REQUIRE(saved);
  jarol::Runner rest(jarol::load(SPECS "/exolauv.yaml"), {.end = 5s, .resumed = &*saved});
  const jarol::RunOutcome outcome = rest.run();
  CHECK(outcome.begun == 2s);
  CHECK(outcome.report.digest == digest);
}

TEST_CASE("what a run can't do is refused before it begins") {
  CHECK_THROWS_WITH_AS(jarol::Runner(jarol::load(SPECS "/exolauv.yaml"), {.end = 1s, .workers = 65}),
                       "a run has 1 to 64 workers, not 65", jarol::NotExecutable);
  CHECK_THROWS_WITH_AS(jarol::Runner(jarol::load(SPECS "/exolauv.yaml"), {.end = 1s, .real_clock = true, .workers = 2}),
                       ".workers belongs to the virtual clock; the real one goes by 'platform'", jarol::NotExecutable);
}

TEST_CASE("what would have been with another gain from 10 s on is run beside the run, and parts from it") {
  jarol::Loaded loaded = jarol::load(SPECS "/exolauv.yaml");
  jarol::WhatIfs what_ifs(
      {{.at = 10s, .set = {"tasks.depth.parameters.kp=0.2"}}},
      {.load = [](const jarol::Overrides& with) { return jarol::load(SPECS "/exolauv.yaml", with); }, .end = 12s},
      *loaded.graph);
  jarol::RunOptions options{.end = 12s};
  what_ifs.add_to(options.sinks);
  what_ifs.add_to(options.stops);
  jarol::Runner runner(std::move(loaded), options);
  runner.begin();
  runner.attend();
  what_ifs.run(runner.joined().sinks());
  const auto digest = runner.finish().report.digest;
  REQUIRE(what_ifs.outcomes().size() == 1);
  CHECK(what_ifs.outcomes()[0].column.digest != digest);
  REQUIRE(what_ifs.outcomes()[0].differences.first());
  CHECK(what_ifs.outcomes()[0].differences.first()->output == "depth.moment");
  CHECK(what_ifs.outcomes()[0].differences.first()->instant == 10s);
}
