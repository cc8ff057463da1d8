// How a run ended, and what was still running then.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/values/type_of.h"

namespace jarol {

struct Ending {
  // over: all of --for was covered, or the mission ended; hung: an activation held up the whole run
  enum class Cause { over, fault, lost, signal, hung };
  Cause cause = Cause::over;
  int signal = 0;      // of Cause::signal
  std::string reason;  // what ended the run, as a sentence without a subject before it: "SIGINT ended the run"

  static Ending over() { return {Cause::over, 0, "the run was over"}; }
  static Ending fault() { return {Cause::fault, 0, "a fault ended the run"}; }
  static Ending lost() { return {Cause::lost, 0, "an external system was lost"}; }
  static Ending of_signal(int signal);
};

/// An activation that runs, or that a thread still ran when the run was over.
struct HangingTask {
  std::string task;
  std::int64_t activation = 0;
  Duration instant{};  // of its release

  friend bool operator==(const HangingTask&, const HangingTask&) = default;
};

/// A distributer that has not returned from a call of the run's: from that instant on, or none: from that of its end.
struct HangingDistributer {
  std::string distributer;
  std::optional<Duration> instant{};

  friend bool operator==(const HangingDistributer&, const HangingDistributer&) = default;
};

/// What threads still run when they were waited for long enough; a thread that does not end may run no task, as one
/// that waits for a link.
struct Finish {
  bool done = true;
  std::vector<HangingTask> hanging{};
};

/// "SIGINT", of one that has no name "signal 40".
std::string signal_text(int signal);

/// "over", "fault", "lost", "signal", "hung".
std::string_view to_text(Ending::Cause cause);

/// One line, as it goes to people: "task 'a' activation 3 at 0.03 s has not ended".
std::string to_text(const HangingTask& hanging);
/// Likewise: "distributer 'display' at 2.9 s has not returned", "distributer 'display' has not finished".
std::string to_text(const HangingDistributer& hanging);

}  // namespace jarol
