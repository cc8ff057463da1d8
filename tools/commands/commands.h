// The subcommands of `jarol`, a file each.
#pragma once

#include <string>

namespace jarol::tools {

class CommandLine;

/// Exit codes of the command, as the README says.
enum ExitCode { exit_good = 0, exit_negative = 1, exit_input = 2, exit_unfinished = 3, exit_interrupted = 130 };

// Each adds its subcommand; `exit_code` is what the program returns once it has run.
void add_bench(CommandLine& line, int& exit_code);
void add_check(CommandLine& line, int& exit_code);
void add_doctor(CommandLine& line, int& exit_code);
void add_graph(CommandLine& line, int& exit_code);
void add_messages(CommandLine& line, int& exit_code);
void add_replay(CommandLine& line, int& exit_code);
void add_run(CommandLine& line, int& exit_code);
void add_schema(CommandLine& line, int& exit_code);
void add_tasks(CommandLine& line, int& exit_code);
void add_vehicle(CommandLine& line, int& exit_code);

}  // namespace jarol::tools
