#include "tools/commands/commands.h"

#include "tools/commands/run/watch_run.h"
#include "tools/report/command_line.h"

namespace jarol::tools {

CommandLine make_command_line(int& exit_code) {
  CommandLine line = make_bare_command_line();
  add_bench(line, exit_code);
  add_campaign(line, exit_code);
  add_check(line, exit_code);
  add_console(line, exit_code);
  add_doctor(line, exit_code);
  add_edit(line, exit_code);
  add_graph(line, exit_code);
  add_isolation(line, exit_code);
  add_log(line, exit_code);
  add_messages(line, exit_code);
  add_new(line, exit_code);
  add_replay(line, exit_code);
  add_run(line, exit_code, watch_run);
  add_schema(line, exit_code);
  add_tasks(line, exit_code);
  add_vehicle(line, exit_code);
  return line;
}

std::vector<std::string> unbuilt_commands() { return {}; }

}  // namespace jarol::tools
