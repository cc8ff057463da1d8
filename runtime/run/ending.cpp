#include "runtime/run/ending.h"

#include <cstring>

#include "graph/language/quantities.h"

namespace jarol {

Ending Ending::of_signal(int signal) { return {Cause::signal, signal, signal_text(signal) + " ended the run"}; }

std::string signal_text(int signal) {
  const char* const name = sigabbrev_np(signal);
  return name != nullptr ? "SIG" + std::string(name) : "signal " + std::to_string(signal);
}

std::string_view to_text(Ending::Cause cause) {
  switch (cause) {
    case Ending::Cause::over: return "over";
    case Ending::Cause::fault: return "fault";
    case Ending::Cause::lost: return "lost";
    case Ending::Cause::signal: return "signal";
    case Ending::Cause::hung: return "hung";
  }
  return "";
}

std::string to_text(const HangingTask& hanging) {
  return "task '" + hanging.task + "' activation " + std::to_string(hanging.activation) + " at " +
         seconds_text(hanging.instant) + " s has not ended";
}

std::string to_text(const HangingDistributer& hanging) {
  const std::string who = "distributer '" + hanging.distributer + "'";
  return hanging.instant ? who + " at " + seconds_text(*hanging.instant) + " s has not returned"
                         : who + " has not finished";
}

}  // namespace jarol
