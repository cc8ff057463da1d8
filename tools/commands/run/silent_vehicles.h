// Vehicles of a run on the real clock that have not said anything yet.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "distributers/links/linked.h"
#include "graph/model/graph.h"
#include "runtime/external_system.h"

namespace jarol::tools {

/// Says at the terminal from which of them nothing has come in the first seconds of a run, and when something does.
class SilentVehicles {
 public:
  /// The run begins now. The graph outlives this; the systems are one per distributer, and do so, too.
  SilentVehicles(const Graph& graph, const std::vector<ExternalSystem*>& systems);

  /// Often; it seldom does anything.
  void look();
  /// The vehicle is brought to rest from now on: of one that was never heard its rest can't be seen, as is said.
  void rest_begins();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds patience{3};
  static constexpr std::chrono::milliseconds interval{500};

  std::vector<std::string> unheard() const;

  struct Vehicle {
    std::string name;
    const distributers::LinkedSystem* link;
  };
  std::vector<Vehicle> vehicles_;  // on links, from which the graph takes something
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_look_ = begin_ + patience;
  bool said_ = false, done_ = false;
};

}  // namespace jarol::tools
