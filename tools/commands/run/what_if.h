// What would have been: runs that have their past in common with another one, and other parameters from there on.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/saved_run.h"
#include "distributers/session/true_state.h"
#include "runtime/record/kept_values.h"
#include "tools/commands/run/run_files.h"

namespace jarol::tools {

struct WhatIf {
  static constexpr std::size_t max_count = 4;

  Duration at{};
  std::vector<std::string> set;    // "path=value" of parameters of tasks
  std::optional<Checkpoint> past;  // of the run, once it has come there
};

/// Of "at=30s set=tasks.depth.parameters.kp=0.2", with any number of `set`. Throws InputError.
std::vector<WhatIf> parse_what_ifs(const std::vector<std::string>& words);
/// As people read it: "at 30 s tasks.depth.parameters.kp=0.2".
std::string to_text(const WhatIf& what_if);

/// How a run ended, beside others.
struct RunColumn {
  std::uint64_t digest = 0;
  std::uint64_t fault_count = 0;
  std::string stopped{};  // the fault that stopped it; empty: none did
  struct Reached {
    std::string title;  // of what was commanded and reported
    std::string unit;   // shown
    double value = 0;
    bool is_true = false;  // where the vehicle truly was
  };
  std::vector<Reached> reached{};
  RunVerdict verdict{};
};

RunColumn column_of(const RunState& state, const Report& report, const std::vector<TrueState>& truth,
                    const RunVerdict& verdict);

/// A what-if that was run, beside its run.
struct WhatIfOutcome {
  const WhatIf& what_if;
  RunColumn column;
  Differences differences;
};

/// All that are asked for.
class WhatIfs {
 public:
  /// Throws InputError.
  explicit WhatIfs(const std::vector<std::string>& words) : what_ifs_(parse_what_ifs(words)) {}

  /// The run that they begin with, until then. Throws SpecError where one is no graph with what it sets.
  void prepare(const Graph& graph, std::string file, Overrides overrides, std::uint64_t seed, std::size_t workers,
               std::string execution, Duration end);
  /// After that: looks on at the run.
  void add_to(std::vector<RecordSink*>& sinks);
  void add_to(std::vector<Stop>& stops);
  /// Once the run is over: each to its end, as lines of the picture, too. Throws what a run and its sinks throw.
  void run(RunSinks& sinks, RunFiles& files);

  const std::vector<WhatIfOutcome>& outcomes() const { return outcomes_; }

 private:
  Loaded load(const WhatIf& what_if, Overrides& overrides) const;
  WhatIfOutcome run(const WhatIf& what_if, RecordSink* beside) const;

  std::vector<WhatIf> what_ifs_;
  std::string file_;
  Overrides overrides_;
  std::uint64_t seed_ = 0;
  std::size_t workers_ = 1;
  std::string execution_;
  Duration end_{};
  std::optional<KeptValues> kept_;
  std::vector<WhatIfOutcome> outcomes_;
};

/// The run and what became of each what-if, side by side; nothing if there is none.
std::string to_text(const RunColumn& run, const std::vector<WhatIfOutcome>& what_ifs);
nlohmann::ordered_json to_json(const std::vector<WhatIfOutcome>& what_ifs);

}  // namespace jarol::tools
