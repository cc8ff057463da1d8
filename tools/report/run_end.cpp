#include "tools/report/run_end.h"

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>

#include "graph/language/quantities.h"
#include "graph/text/escape.h"
#include "tools/report/exit_code.h"

namespace jarol::tools {

void halt_if_asked(const RunEnd& end) {
  if (end.ending.signal != SIGTSTP) return;
  std::signal(SIGTSTP, SIG_DFL);
  std::raise(SIGTSTP);
}

std::string suffix_of(const RunEnd& end) {
  switch (end.ending.cause) {
    case Ending::Cause::signal: return end.ending.signal == SIGTSTP ? " (halted by Ctrl-Z)" : " (interrupted)";
    case Ending::Cause::lost:
    case Ending::Cause::hung: return " (broken off)";
    case Ending::Cause::over:
    case Ending::Cause::fault: return "";
  }
  return "";
}

std::string errors_of(const RunEnd& end, Duration now) {
  std::string text;
  if (end.failure) {
    try {
      std::rethrow_exception(end.failure);
    } catch (const std::exception& error) {
      text += "error: at " + seconds_text(now) + " s: " + error.what() + "\n";
    } catch (...) { text += "error: at " + seconds_text(now) + " s: something was thrown that is no exception\n"; }
  }
  for (const std::string& unkept : end.unkept) text += "error: " + printable(unkept) + "\n";
  for (const HangingTask& hanging : end.hanging) text += "error: " + to_text(hanging) + "\n";
  if (end.distributer) text += "error: " + to_text(*end.distributer) + "; the program ends without it\n";
  if (end.hangs && (!end.distributer || !end.hanging.empty()))
    text += end.hanging.empty() ? "error: a thread has not ended that runs no task; the program ends without it\n"
                                : "error: threads have not ended; the program ends without them\n";
  if (end.ending.cause == Ending::Cause::hung && !end.hangs) text += "error: " + end.ending.reason + "\n";
  return text;
}

nlohmann::ordered_json to_json(const RunEnd& end) {
  auto hanging = nlohmann::ordered_json::array();
  for (const HangingTask& h : end.hanging)
    hanging.push_back({{"task", h.task}, {"activation", h.activation}, {"instant_ns", h.instant.count()}});
  if (end.distributer)
    hanging.push_back(
        {{"distributer", end.distributer->distributer},
         {"instant_ns", end.distributer->instant ? nlohmann::ordered_json(end.distributer->instant->count())
                                                 : nlohmann::ordered_json()}});
  return {{"cause", to_text(end.ending.cause)},
          {"signal",
           end.ending.signal == 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(signal_text(end.ending.signal))},
          {"reason", end.ending.reason},
          {"hanging", hanging}};
}

int exit_code_of(const RunEnd& end) {
  const Ending::Cause cause = end.ending.cause;
  const bool unfinished = end.must_end_at_once() || end.failure || !end.unkept.empty() ||
                          cause == Ending::Cause::fault || cause == Ending::Cause::hung;
  return exit_of({unfinished ? exit_unfinished : exit_good, exit_of_signal(end.ending.signal)});
}

}  // namespace jarol::tools
