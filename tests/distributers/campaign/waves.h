// Campaigns of graphs without vehicles: sums of sines whose gains and seeds vary, and a mission in a file.
#pragma once

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "distributers/campaign/run_all.h"
#include "distributers/campaign/summary.h"
#include "graph/campaign/draws.h"
#include "tasks/values/lauv.h"
#include "tests/distributers/all_parts.h"

namespace jarol::campaign::trial {
namespace fs = std::filesystem;

struct Unsteady {
  static constexpr std::string_view summary = "a sum of sines, which fails when it is asked to";
  struct Param {
    double gain = 1;
    std::int64_t fails_at = -1;
    std::int64_t stops_being_finite_at = -1;
    static constexpr auto fields() {
      return describe(field<&Param::gain>(), field<&Param::fails_at>(), field<&Param::stops_being_finite_at>());
    }
  };
  struct State {
    double phase = 0;
    static constexpr auto fields() { return describe(field<&State::phase>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick& tick, State& state, Out& out) {
    if (tick.activation == p.fails_at) throw std::runtime_error("it was to fail");
    state.phase += p.gain * 0.1;
    out.out = tick.activation == p.stops_being_finite_at ? HUGE_VAL : p.gain * std::sin(state.phase);
  }
};

struct DepthOf {
  static constexpr std::string_view summary = "the depth of a setpoint";
  struct In {
    tasks::Setpoint setpoint{};
    static constexpr auto fields() { return describe(field<&In::setpoint>()); }
  };
  struct Out {
    double depth = 0;
    static constexpr auto fields() { return describe(field<&Out::depth>()); }
  };
  static void run(const Tick&, const In& in, Out& out) { out.depth = in.setpoint.depth; }
};

inline const std::string waves = R"(
graph: waves
timing: {period: 10ms}
tasks:
  a: {type: Unsteady, wcet: 1us}
  b: {type: Unsteady, wcet: 1us, period: 5ms, let: 3ms, parameters: {gain: 0.5}}
  sum: {type: Sum, wcet: 1us}
connections: [a.out -> sum.a, b.out -> sum.b]
expect: [max(sum.out) < 2.3]
campaign:
  for: 2s
  metrics: {most: max(sum.out), mean: mean(abs(sum.out)), early: time of a.out > 0.5}
)";

struct Folder {
  Folder() : path(fs::temp_directory_path() / ("campaign_test_" + std::to_string(::getpid()))) {
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const std::string& name) const { return path / name; }
  fs::path path;
};

inline GraphSource source_of(const std::string& text, std::vector<std::string> metrics = {}) {
  return {std::make_shared<const Source>(Source{"t.yaml", text}),
          jarol::tests::all_parts_with<Unsteady, DepthOf>(),
          {},
          std::move(metrics)};
}

// The mission beside it, dive.csv, says how deep.
inline GraphSource diving(const std::string& file, const std::string& expected = "") {
  const std::string text =
      "graph: g\n"
      "distributers: {neptus: {type: LauvOperator, link: {type: script, file: dive.csv}}}\n"
      "communicators: {setpoint: {channel: neptus.setpoint, period: 100ms}}\n"
      "tasks: {depth: {type: DepthOf, wcet: 1us, period: 100ms}}\n"
      "connections: [setpoint -> depth.setpoint]\n"
      "campaign: {metrics: {deepest: max(depth.depth)}}\n";
  return {std::make_shared<const Source>(Source{file, text + expected}),
          jarol::tests::all_parts_with<Unsteady, DepthOf>(),
          {},
          {}};
}

inline std::string dive_to(double depth) {
  const std::string row = "," + number_text(depth) + ",0deg,0\n";
  return "time,setpoint.depth,setpoint.heading,setpoint.speed\n0" + row + "5" + row;
}

// A campaign under way.
struct Under {
  Under(const GraphSource& of, const Wishes& wishes, std::uint64_t seed, const std::string& file)
      : source(of), graphs(source), campaign(state_campaign(graphs, wishes)), draws(campaign, seed) {
    results.emplace(file, identity_of(source, graphs, campaign, seed, {{"program", "test"}}), campaign);
  }

  void run(std::size_t workers, const Shard& shard = {}) {
    run_all(graphs, campaign, draws, missing(results->done(draws.runs()), shard.of(draws.runs())), workers, *results,
            [this](const Result&) {
              if (++seen == stop_after) stop = true;
            },
            {stop, stuck});
  }

  std::string csv() const {
    std::string text;
    write_csv(*results, campaign, draws, [&](std::string_view more) { text += more; });
    return text;
  }

  std::vector<Result> all() const {
    std::vector<Result> found;
    results->for_each([&](const Result& result) { found.push_back(result); });
    return found;
  }

  GraphSource source;
  Graphs graphs;
  Campaign campaign;
  Draws draws;
  std::optional<Results> results;
  std::size_t seen = 0, stop_after = 0;
  std::atomic<bool> stop{false};
  StuckRuns* stuck = nullptr;
};

inline const Wishes gains{
    .vary = {"tasks.a.parameters.gain=0.5..1.5", "tasks.b.parameters.gain=normal(1, 0.3)", "seed=1..30"}};

}  // namespace jarol::campaign::trial
