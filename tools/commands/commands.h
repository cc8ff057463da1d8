// The subcommands of `jarol`, a file each.
#pragma once

#include <string>

#include "tools/report/exit_code.h"

namespace jarol::tools {

class CommandLine;

// Each adds its subcommand; `exit_code` is what the program returns once it has run.
void add_bench(CommandLine& line, int& exit_code);
void add_campaign(CommandLine& line, int& exit_code);
void add_check(CommandLine& line, int& exit_code);
void add_console(CommandLine& line, int& exit_code);
void add_doctor(CommandLine& line, int& exit_code);
void add_edit(CommandLine& line, int& exit_code);
void add_graph(CommandLine& line, int& exit_code);
void add_isolation(CommandLine& line, int& exit_code);
void add_log(CommandLine& line, int& exit_code);
void add_messages(CommandLine& line, int& exit_code);
void add_new(CommandLine& line, int& exit_code);
void add_replay(CommandLine& line, int& exit_code);
void add_run(CommandLine& line, int& exit_code);
void add_schema(CommandLine& line, int& exit_code);
void add_tasks(CommandLine& line, int& exit_code);
void add_vehicle(CommandLine& line, int& exit_code);

/// All of them.
CommandLine make_command_line(int& exit_code);

}  // namespace jarol::tools
