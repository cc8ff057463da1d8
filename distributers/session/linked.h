// The external systems of a run while they are connected.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/note_sink.h"
#include "runtime/execute/attend.h"
#include "runtime/execute/failsafe.h"
#include "runtime/external_system.h"

namespace jarol {

std::vector<ExternalSystem*> pointers_to(const std::vector<std::unique_ptr<ExternalSystem>>& all);

/// External systems that are on links run while this lives.
class Linked {
 public:
  /// Throws InputError if there is no way to an external system.
  Linked(std::vector<ExternalSystem*> systems, NoteSink note);
  ~Linked() { finish(); }
  Linked(const Linked&) = delete;
  Linked& operator=(const Linked&) = delete;

  /// What can't be kept for the next run is noted, and the rest goes on.
  void finish();
  /// The same on another thread, which is waited for until then, and for finish_patience at least once it has begun.
  /// The one that has not finished by then, by its number:
  /// it runs on, and neither it nor those behind it may be used or destroyed any more. What can't be kept comes to
  /// `unkept`.
  std::optional<std::size_t> finish_until(Futex::Time time, std::vector<std::string>& unkept);
  std::vector<LinkReport> reports() const;

 private:
  std::vector<ExternalSystem*> systems_;
  NoteSink note_;
};

/// Has them finish before the run's patience is over, or notes there which one hangs.
void finish_links(Linked& linked, const Graph& graph, RunEnd& end);

/// What is handed over at the end, but for what a link still sends that hangs, and for what it could not send.
std::vector<FailsafeReport> failsafe_after(const RunEnd& end, const Graph& graph,
                                           const std::vector<ExternalSystem*>& systems,
                                           std::vector<FailsafeReport> reports);

}  // namespace jarol
