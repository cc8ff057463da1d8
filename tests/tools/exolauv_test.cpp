// The dive, from the file that users run: what it has to reach.
#include <doctest/doctest.h>

#include "tests/tools/dive.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "distributers/lauv/operator.h"
#include "runtime/execute/executor.h"
#include "tasks/lauv/supervisor.h"
#include "tasks/values/lauv.h"
#include "tests/how_many.h"
#include "tools/commands/run/load_graph.h"
#include "tools/report/value_json.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

using test::Dive;
using test::dive;
using test::Sample;

const Dive& the_dive() {
  static const Dive done = dive("specs/exolauv.yaml");
  return done;
}

constexpr double degree = std::numbers::pi / 180;
constexpr double command_at = 2, turn_at = 50;  // s, as in specs/missions/dive.csv
}  // namespace

TEST_SUITE("tools/exolauv") {
  TEST_CASE("the limits of plans are those of its supervisor and of what its propeller reaches, in each profile") {
    for (const char* profile :
         {"", "at_sea", "submarine_dune", "submarine_vsim", "dune", "console", "desk", "lab", "dune_console"}) {
      CAPTURE(profile);
      const Loaded loaded = tools::load_without_systems("specs/exolauv.yaml", {.profile = profile, .set = {}});
      const auto parameters_of = [](const auto& all, const char* name) -> const void* {
        for (const auto& each : all)
          if (each.name == name) return each.parameters.data();
        return nullptr;
      };
      const auto* supervisor =
          static_cast<const tasks::LauvSupervisor::Param*>(parameters_of(loaded.graph->tasks, "supervisor"));
      const auto* console =
          static_cast<const distributers::LauvOperatorParameters*>(parameters_of(loaded.graph->distributers, "neptus"));
      REQUIRE(supervisor != nullptr);
      REQUIRE(console != nullptr);
      const distributers::FlightLimits& limits = console->limits;
      CHECK(limits.max_depth == supervisor->max_depth);
      CHECK(limits.min_altitude == supervisor->min_altitude);
      CHECK(supervisor->surge_drag * limits.max_speed * (1 + limits.max_speed) <= supervisor->max_thrust * 1.0001);
    }
  }

  TEST_CASE("the profile for DUNE with a console has all of the one for DUNE, and the link of the one for a console") {
    const auto load = [](const char* profile) {
      return tools::load_without_systems("specs/exolauv.yaml", {.profile = profile, .set = {}});
    };
    const Loaded both = load("dune_console"), dune = load("dune"), console = load("console");
    const auto text_of = [](const Value& value) { return tools::graph_text(*value.type(), value.data()); };
    const auto flat = [](const Yaml& link) {
      std::string text;
      for (const Yaml& child : link.children) text += child.key + " " + child.text + ", ";
      return text;
    };
    const auto named = [](const auto& all, const std::string& name) {
      return *std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == name; });
    };
    const auto distributer = [&](const Loaded& of, const char* name) { return named(of.graph->distributers, name); };
    for (const char* name : {"dune", "neptus"})
      CHECK(text_of(distributer(both, name).parameters) == text_of(distributer(dune, name).parameters));
    CHECK(text_of(named(both.graph->tasks, "supervisor").parameters) ==
          text_of(named(dune.graph->tasks, "supervisor").parameters));
    CHECK(flat(distributer(both, "dune").link) == flat(distributer(dune, "dune").link));
    CHECK(flat(distributer(both, "neptus").link) == flat(distributer(console, "neptus").link));
    CHECK(flat(distributer(both, "neptus").link) ==
          "type udp, listen 6001, peers 4, id 0x00D1, announce 127.0.0.1:30100-30104, ");
  }

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

  // What is left of the goals at sea: how far the true depth, heading and speed are from those commanded, settled.
  struct Errors {
    double depth = 0, heading = 0, speed = 0;
  };
  Errors errors_of(const Dive& done) {
    Errors worst;
    for (const Sample& s : done.samples) {
      if (s.time >= command_at + 30) worst.depth = std::max(worst.depth, std::abs(s.motion.z - 3));
      if (s.time >= turn_at + 20) worst.heading = std::max(worst.heading, std::abs(s.motion.psi - 90 * degree));
      if (s.time >= command_at + 15) worst.speed = std::max(worst.speed, std::abs(s.motion.u - 1.2));
    }
    return worst;
  }

  TEST_CASE("at sea, with noise, current and small waves, it keeps depth within 5 cm and heading within 2 degrees") {
    const std::uint64_t seeds = tests::how_many(1, 20);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      CAPTURE(seed);
      const Dive done = dive("specs/exolauv.yaml:at_sea", {}, seed);
      const Errors worst = errors_of(done);
      MESSAGE("depth " << worst.depth << " m, heading " << worst.heading / degree << " deg, speed " << worst.speed);
      CHECK(worst.depth < 0.05);
      CHECK(worst.heading < 2 * degree);
      CHECK(worst.speed < 0.1);
      CHECK(done.alarm == tasks::Alarm::none);
    }
  }

  // specs/flying.md says so of seeds 1 to 100
  TEST_CASE("at sea it keeps its true depth within 3.9 cm from 30 s on with every seed but 51, which needs 4.2") {
    constexpr std::uint64_t widest = 51;
    std::vector<std::uint64_t> seeds{widest};
    if (!tests::tries_less) seeds.insert(seeds.end(), {1, 2});
    if (tests::is_full()) {
      seeds.resize(100);
      std::iota(seeds.begin(), seeds.end(), 1);
    }
    for (const std::uint64_t seed : seeds) {
      CAPTURE(seed);
      const Dive done = dive("specs/exolauv.yaml:at_sea", {"distributers.dune.link.parameters.dynamics=rigid"}, seed);
      double worst = 0;
      for (const Sample& s : done.samples)
        if (s.time >= 30) worst = std::max(worst, std::abs(s.motion.z - 3));
      CHECK(done.samples.back().time > turn_at + 20);
      CHECK(done.alarm == tasks::Alarm::none);
      CHECK(worst > 0.02);  // there are waves
      CHECK(worst < (seed == widest ? 0.042 : 0.039));
      if (seed == widest) CHECK(worst > 0.039);  // or it is no exception any more
    }
  }

  TEST_CASE("in waves of half a metre it moves with the water and fails to keep depth within 5 cm") {
    const Dive done = dive("specs/exolauv.yaml:at_sea",
                           {"distributers.dune.link.parameters={sea: {wave_height: 0.5, wave_period: 5}}"}, 1);
    const Errors worst = errors_of(done);
    MESSAGE("depth " << worst.depth << " m, heading " << worst.heading / degree << " deg, speed " << worst.speed);
    CHECK(worst.depth > 0.05);
    CHECK(worst.depth < 0.25);  // water there moves by 0.15 m
    CHECK(worst.heading < 4 * degree);
    CHECK(done.alarm == tasks::Alarm::none);
  }

  TEST_CASE("at sea another seed gives another digest, the same the same") {
    const auto digest = [](std::uint64_t seed) {
      return dive("specs/exolauv.yaml:at_sea", {}, seed, 5s).report.digest;
    };
    CHECK(digest(1) == digest(1));
    CHECK(digest(1) != digest(2));
    CHECK(dive("specs/exolauv.yaml", {}, 1, 5s).report.digest == dive("specs/exolauv.yaml", {}, 2, 5s).report.digest);
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
