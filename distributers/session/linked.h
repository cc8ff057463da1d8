// The channels of a run while they are connected.
#pragma once

#include <memory>
#include <vector>

#include "distributers/session/note_sink.h"
#include "runtime/external_system.h"

namespace jarol {

std::vector<ExternalSystem*> pointers_to(const std::vector<std::unique_ptr<ExternalSystem>>& all);

/// Channels that are on links run while this lives.
class Linked {
 public:
  /// Throws std::runtime_error if there is no way to an external system.
  Linked(std::vector<ExternalSystem*> channels, NoteSink note);
  ~Linked() { finish(); }
  Linked(const Linked&) = delete;
  Linked& operator=(const Linked&) = delete;

  /// What can't be kept for the next run is noted, and the rest goes on.
  void finish();
  std::vector<LinkReport> reports() const;

 private:
  std::vector<ExternalSystem*> channels_;
  NoteSink note_;
};

}  // namespace jarol
