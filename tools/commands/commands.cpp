#include "tools/commands/commands.h"

#include "tools/report/command_line.h"
#include "tools/report/version.h"

namespace jarol::tools {

CommandLine make_command_line(int& exit_code) {
  CommandLine line(
      "jarol",
      "Jarol runs control programs that are graphs of isolated tasks: checked for schedulability, the same to the bit "
      "every time.\n\n  jarol check specs/exolauv.yaml     can it be scheduled, and if not, why\n"
      "  jarol run specs/exolauv.yaml       run it on the virtual clock\n"
      "  jarol tasks                        what a graph can be made of\n"
      "  jarol help run                     all about a command\n",
      version_text());
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
  add_run(line, exit_code);
  add_schema(line, exit_code);
  add_tasks(line, exit_code);
  add_vehicle(line, exit_code);
  return line;
}

}  // namespace jarol::tools
