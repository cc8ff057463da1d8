// The commands that tools/demo builds, sooner than all are. tools/build builds the others.

#include <string>

#include "graph/text/errors.h"
#include "tools/commands/commands.h"
#include "tools/commands/later.h"
#include "tools/console/view.h"
#include "tools/report/command_line.h"

namespace jarol::tools {
namespace {

std::unique_ptr<console::View> watch_nothing(const RunArguments&, const Loaded&, Duration, Pace*) {
  throw InputError("the web pages of --console are not built yet; tools/build --page builds them, by npm");
}

}  // namespace

CommandLine make_command_line(int& exit_code) {
  std::string others;
  for (const std::string later : later_commands) others += (others.empty() ? "" : ", ") + later;
  CommandLine line =
      make_bare_command_line("\nThese are the first commands; tools/build builds the others: " + others + ".\n");
  add_check(line, exit_code);
  add_run(line, exit_code, watch_nothing);
  add_tasks(line, exit_code);
  return line;
}

std::vector<std::string> unbuilt_commands() { return {later_commands.begin(), later_commands.end()}; }

}  // namespace jarol::tools
