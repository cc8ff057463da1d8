#include <doctest/doctest.h>
#include <jarol/runner.h>

using namespace std::chrono_literals;

TEST_CASE("a dive is recorded, and its replay is the same to the last value") {
  jarol::RunOptions options{.end = 5s};
  options.recording.file = "dive.mcap";
  jarol::Runner runner(jarol::load(SPECS "/exolauv.yaml"), options);
  const jarol::RunOutcome outcome = runner.run();
  CHECK(outcome.simulated == 5s);
  jarol::RecordedRun log("dive.mcap");
  jarol::Replayer replayer(log, jarol::built_in());
  CHECK(replayer.run().comparison.evidence == jarol::Evidence::same);
}
