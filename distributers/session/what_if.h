// What would have been: runs that have their past in common with another one, and other parameters from there on.
//
//   WhatIfs what_ifs({{.at = 30s, .set = {"tasks.depth.parameters.kp=0.2"}}}, setup);
//   what_ifs.add_to(options.sinks), what_ifs.add_to(options.stops);
//   Runner runner(std::move(loaded), options);
//   runner.begin(), runner.attend();
//   what_ifs.run(runner.joined().sinks());
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/load.h"
#include "distributers/session/reached.h"
#include "distributers/session/run_sinks.h"
#include "distributers/session/saved_run.h"
#include "runtime/execute/attend.h"
#include "runtime/record/differences.h"
#include "runtime/record/kept_values.h"

namespace jarol {

struct WhatIf {
  Duration at{};
  std::vector<std::string> set{};    // "path=value" of parameters of tasks
  std::optional<Checkpoint> past{};  // of the run, once it has come there
};

/// As people read it: "at 30 s tasks.depth.parameters.kp=0.2".
std::string to_text(const WhatIf& what_if);

/// A what-if that was run, beside its run.
struct WhatIfOutcome {
  const WhatIf& what_if;
  RunColumn column;
  Differences differences;
};

/// The run that they begin with.
struct WhatIfSetup {
  std::function<Loaded(const Overrides&)> load{};  // its graph
  Overrides overrides{};
  std::uint64_t seed = 0;
  std::size_t workers = 1;
  std::string execution{};
  Duration end{};
  // how messages name what asks for them, and the execution times
  std::string option = ".what_if", execution_option = ".execution";
};

/// All that are asked for.
class WhatIfs {
 public:
  /// Throws SpecError where one is no graph with what it sets.
  WhatIfs(std::vector<WhatIf> what_ifs, WhatIfSetup setup, const Graph& graph);

  /// Looks on at the run.
  void add_to(std::vector<RecordSink*>& sinks);
  void add_to(std::vector<Stop>& stops);
  /// Who gets what is published, by its number from 0; null: nobody does.
  using MakeSink = std::function<std::unique_ptr<RecordSink>(std::size_t)>;
  /// Once the run is over: each to its end. Throws what a run and its sinks throw.
  void run(
      RunSinks& sinks, const MakeSink& make_sink = [](std::size_t) { return nullptr; },
      const std::function<Wish()>& wish = [] { return Wish{}; });

  const std::vector<WhatIfOutcome>& outcomes() const { return outcomes_; }

 private:
  Loaded load(const WhatIf& what_if, Overrides& overrides) const;
  WhatIfOutcome run(const WhatIf& what_if, RecordSink* beside, const std::function<Wish()>& wish) const;

  std::vector<WhatIf> what_ifs_;
  const WhatIfSetup setup_;
  std::optional<KeptValues> kept_;
  std::vector<WhatIfOutcome> outcomes_;
};

}  // namespace jarol
