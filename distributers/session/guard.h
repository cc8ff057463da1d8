// The guardian of a run: who hands over `safe` when the run is gone.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "distributers/guardian/guardian.h"
#include "distributers/session/load.h"

namespace jarol {

/// Of the links to what goes on by itself that have an `out` with a `safe`. Where there is none to be had, that is
/// noted, and the run does without.
class Guard {
 public:
  /// Before links connect, and before the systems are wrapped; outlives them. `unwanted`: why there is none; empty:
  /// there is one.
  Guard(const Loaded& loaded, const std::string& unwanted, std::optional<int> priority, const NoteSink& note);

  /// The first instant comes: from now on what ends the process without `close` is a crash.
  void arm() const;
  /// Now and then while the run goes on: notes once that it is gone.
  void look(const NoteSink& note);
  /// After the links were closed.
  void close();

  /// Null: there is none.
  const distributers::Guardian* process() const { return guardian_.get(); }

  /// The communicators that it could hand over, or could if it were there.
  const std::vector<std::string>& safe() const { return safe_; }
  /// Links with a `safe` that it can't hold, as people read them.
  const std::vector<std::string>& unreached() const { return unreached_; }
  /// Why there is none, or was none at the end; empty: there was.
  const std::string& missing() const { return missing_; }

 private:
  std::vector<std::string> safe_, unreached_;
  std::unique_ptr<distributers::Guardian> guardian_;
  std::string missing_;
  bool reported_ = false;
};

/// Empty, or why no guardian can be started on this machine.
std::string guardian_refused();

}  // namespace jarol
