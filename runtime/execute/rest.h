// How the vehicle of a run comes to rest at its end, as the graph states in `at_end`: what its operator commands then,
// and when that is done.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/execute/failsafe.h"
#include "runtime/external_system.h"
#include "runtime/state/run_state.h"

namespace jarol {

struct RestReport {
  Duration begun{};      // the first instant at which the command was in force
  Duration ended{};      // the instant reached after that
  bool reached = false;  // the vehicle was at rest then
  bool heard = true;     // by what it reports, not by what it did long ago or never
};

/// Used by the thread that publishes, while it does not.
class Rest {
 public:
  /// Of a graph that states it, and taps the signals of its condition. All outlive this.
  Rest(RunState& state, const std::vector<std::unique_ptr<ExternalSystem>>& systems);

  Duration longest() const { return at_end_.longest; }
  /// Nothing more is taken from that distributer: it plays a mission, which is over.
  bool is_mission(std::size_t distributer) const { return missions_[distributer]; }
  /// Puts what is commanded into the communicator's value; false: nothing of it is, or its operator commands.
  bool command(std::size_t communicator, void* value) const;
  /// Before the first instant at which it commands, or again later, which changes nothing.
  void begin();
  bool has_begun() const { return begun_; }
  /// By what was published since it began, while all vehicles are heard.
  bool is_reached(const Failsafe& inputs, Duration instant);
  /// When that was asked last.
  bool was_heard() const { return heard_; }

 private:
  bool hears_vehicles(const Failsafe& inputs, Duration instant) const;

  const AtEnd& at_end_;
  RunState& state_;
  bool begun_ = false, heard_ = true;
  // per vehicle that reports anything: all of the first are to be heard, or any of them if none has a time-out
  struct Ins {
    std::vector<std::size_t> with_timeout, others;
  };
  std::vector<Ins> vehicles_;
  std::vector<bool> missions_;                  // per distributer
  std::vector<const EndCommand*> commands_;     // per communicator, null where nothing is commanded
  std::vector<const ExternalSystem*> systems_;  // per communicator, null where it has none
  std::vector<double> signals_;
};

}  // namespace jarol
