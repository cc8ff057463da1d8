// The guardian of a run: who hands over `safe` when the run is gone.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "distributers/guardian/guardian.h"
#include "tools/run/load_graph.h"

namespace jarol::tools {

/// Of the links to what goes on by itself that have an `out` with a `safe`. Where there is none to be had, a note says
/// why, and the run does without.
class Guard {
 public:
  /// Before links connect, and before the channels are wrapped; outlives them. Not `wanted`: there is none.
  Guard(const Loaded& loaded, bool wanted, std::optional<int> priority);

  /// The first instant comes: from now on what ends the process without `close` is a crash.
  void arm() const;
  /// After the links were closed.
  void close();

  /// Null: there is none.
  const distributers::Guardian* process() const { return guardian_.get(); }

  /// A line, or nothing where there is nothing that it could hand over; the same as an object, or null.
  std::string to_text() const;
  nlohmann::ordered_json to_json() const;

 private:
  std::vector<std::string> safe_;  // communicators
  std::unique_ptr<distributers::Guardian> guardian_;
  std::string missing_;  // why there is none, or was none at the end
};

/// Empty, or why no guardian can be started on this machine.
std::string guardian_refused();

}  // namespace jarol::tools
