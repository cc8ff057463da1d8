#include "tools/commands/run/prompt_line.h"

#include <limits.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>

#include "graph/text/escape.h"

namespace jarol::tools {

void write_promptly(std::string_view line) {
  pollfd stderr_now{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&stderr_now, 1, 0) != 1 || (stderr_now.revents & POLLOUT) == 0) return;
  // a pipe that takes anything takes as much
  [[maybe_unused]] const auto written =
      ::write(STDERR_FILENO, line.data(), std::min<std::size_t>(line.size(), PIPE_BUF));
}

void note_promptly(const std::string& text) { write_promptly("note: " + printable(text) + "\n"); }

void report_stuck(const HangingTask& task) {
  note_promptly(to_text(task) + " for a while; if it never does, Ctrl-C ends the run");
}

void report_stuck_in_run(std::uint64_t run, const HangingTask& task) {
  note_promptly(
      "run " + std::to_string(run) + ": " + to_text(task) +
      " for a while; if it never does, Ctrl-C twice ends the campaign, with the results of all runs that are done");
}

void report_waits_for_runs(std::size_t runs) {
  note_promptly("waits for " + (runs == 1 ? "a run" : std::to_string(runs) + " runs") +
                " to end; Ctrl-C again ends the campaign at once, with the results of all runs that are done");
}

}  // namespace jarol::tools
