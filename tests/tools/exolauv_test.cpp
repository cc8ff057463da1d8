// The dive, from the file that users run: what it has to reach.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "runtime/executor.h"
#include "tasks/values/lauv.h"
#include "tools/load_graph.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

struct Sample {
  double time = 0;
  tasks::Motion motion;
};

// Every motion of the run, in order.
class Motions : public RecordSink {
 public:
  explicit Motions(std::uint32_t output) : output_(output) {}
  void take(Duration instant, std::uint32_t output, const void* value) override {
    if (output == output_)
      samples.push_back({1e-9 * static_cast<double>(instant.count()), *static_cast<const tasks::Motion*>(value)});
  }
  void finish() override {}
  std::vector<Sample> samples;

 private:
  std::uint32_t output_;
};

struct Dive {
  std::vector<Sample> samples;
  Report report;
};

Dive dive(const std::string& file) {
  auto loaded = tools::load_graph(file, {});
  const Plan plan(*loaded.graph);
  const auto at =
      std::find_if(plan.outputs.begin(), plan.outputs.end(), [](const Output& o) { return o.name == "from_dune"; });
  REQUIRE(at != plan.outputs.end());
  Motions motions(static_cast<std::uint32_t>(at - plan.outputs.begin()));
  Recorder recorder({&motions});
  Duration end{};
  for (const auto& channels : loaded.channels) end = std::max(end, channels->end().value_or(Duration{}));
  Executor executor(*loaded.graph, std::move(loaded.channels), {.digest = true, .recorder = &recorder});
  executor.run_until(end);
  recorder.close();
  return {motions.samples, executor.report()};
}

const Dive& the_dive() {
  static const Dive done = dive("specs/exolauv.yaml");
  return done;
}

constexpr double degree = std::numbers::pi / 180;
constexpr double command_at = 2, turn_at = 50;  // s, as in specs/missions/dive.csv
}  // namespace

TEST_SUITE("tools/exolauv") {
  TEST_CASE("it reaches 3 m within 30 s of the command and holds it within 5 cm, through the turn too") {
    double deepest = 0;
    for (const Sample& s : the_dive().samples) {
      if (s.time >= command_at + 30) CHECK(std::abs(s.motion.z - 3) < 0.05);
      deepest = std::max(deepest, s.motion.z);
    }
    CHECK(deepest < 3.3);
  }

  TEST_CASE("it turns by 90 degrees, overshoots by less than 10 % and ends within 2 degrees") {
    double furthest = 0;
    for (const Sample& s : the_dive().samples) {
      if (s.time < turn_at) CHECK(std::abs(s.motion.psi) < 1 * degree);
      furthest = std::max(furthest, s.motion.psi);
      if (s.time >= turn_at + 20) CHECK(std::abs(s.motion.psi - 90 * degree) < 2 * degree);
    }
    CHECK(furthest < 99 * degree);
  }

  TEST_CASE("it takes up 1.2 m/s, overshoots by less than 10 % and stays within 0.05 m/s, through the turn too") {
    for (const Sample& s : the_dive().samples) {
      CHECK(s.motion.u < 1.32);
      if (s.time >= command_at + 10) CHECK(std::abs(s.motion.u - 1.2) < 0.05);
    }
  }

  TEST_CASE("ten dives have one digest") {
    for (int i = 0; i < 9; ++i) CHECK(dive("specs/exolauv.yaml").report.digest == the_dive().report.digest);
  }

  TEST_CASE("the passthrough forwards: the rudders turn the vehicle to port and back to straight") {
    const Dive forward = dive("specs/passthrough.yaml");
    const auto at = [&](double time) {
      return std::find_if(forward.samples.begin(), forward.samples.end(),
                          [&](const Sample& s) { return s.time >= time; })
          ->motion;
    };
    CHECK(std::abs(at(19).psi) < 1 * degree);
    CHECK(at(29).r < -0.02);
    CHECK(std::abs(at(59).r) < 0.01);
    CHECK(forward.report.fault_count == 0);
  }
}
