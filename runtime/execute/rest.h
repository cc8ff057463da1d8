// How the vehicle of a run comes to rest at its end, as the graph states in `at_end`: what its operator commands then,
// and when that is done.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/channels.h"
#include "runtime/plan/plan.h"

namespace jarol {

struct RestReport {
  Duration begun{};      // the first instant at which the command was in force
  Duration ended{};      // the instant reached after that
  bool reached = false;  // the vehicle was at rest then
};

/// Used by the thread that publishes, while it does not.
class Rest {
 public:
  /// Of a graph that states it. All outlive this.
  Rest(const Graph& graph, const Plan& plan, const std::vector<std::unique_ptr<Channels>>& channels);

  Duration longest() const { return at_end_.longest; }
  /// Nothing more is taken from that distributer: it plays a mission, which is over.
  bool is_mission(std::size_t distributer) const { return missions_[distributer]; }
  /// Puts what is commanded into the communicator's value; false: nothing of it is.
  bool command(std::size_t communicator, void* value) const;
  /// By what was published last.
  bool is_reached();

 private:
  const AtEnd& at_end_;
  const Plan& plan_;
  std::vector<bool> missions_;               // per distributer
  std::vector<const EndCommand*> commands_;  // per communicator, null where nothing is commanded
  std::vector<double> signals_;
};

}  // namespace jarol
