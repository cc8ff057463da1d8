// A graph that is loaded and planned once, for any number of runs, at once or one after the other.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "distributers/session/load.h"
#include "runtime/plan/plan.h"

namespace jarol {

/// What is a run's own before its first instant: all else is the graph's and its plan's.
struct RunStart {
  /// Of a task whose parameters are not those of the graph.
  struct Parameters {
    std::size_t task = 0;
    Value values;
  };
  std::vector<Parameters> parameters;
  std::vector<std::unique_ptr<ExternalSystem>> systems;  // one per distributer of the graph
};

/// Constant: threads may start runs at once.
class PlannedGraph {
 public:
  /// Throws SpecError as load_graph does. `known` outlives it.
  PlannedGraph(const std::shared_ptr<const Source>& source, const distributers::Registries& known,
               const Overrides& overrides, const NoteSink& note = no_notes);

  const Graph& graph() const { return *loaded_.graph; }
  /// With what its plugins bring.
  const distributers::Registries& known() const { return *loaded_.known; }
  const Plan& plan() const { return plan_; }
  const campaign::Campaign& campaign() const { return loaded_.campaign; }
  const std::vector<expect::TrueValues>& true_values() const { return loaded_.true_values; }

  /// Is the value at that path, as of --set, a run's own? Parameters of tasks and distributers are, and those of
  /// simulated vehicles. Else it is part of the plan.
  static bool is_of_run(const std::string& path);

  /// A run with these changes, "path=value" of paths that are a run's own, and with that seed of all noise: the same
  /// as the one of a graph that is loaded with them. Throws SpecError.
  RunStart start(const std::vector<std::string>& set, std::uint64_t seed) const;

 private:
  void change_tasks(const std::vector<std::string>& set, RunStart& start, Problems& problems) const;
  std::vector<Distributer> change_distributers(const std::vector<std::string>& set, Problems& problems) const;

  Loaded loaded_;  // its systems were made to see that they can be, and are gone
  Plan plan_;
};

}  // namespace jarol
