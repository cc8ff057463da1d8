// The subcommands of `jarol`, a file each.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace jarol::tools {

/// Exit codes of the command (DESIGN section 8).
enum ExitCode { exit_good = 0, exit_negative = 1, exit_input = 2, exit_unfinished = 3, exit_interrupted = 130 };

// Each adds its subcommand; `exit_code` is what the program returns once it has run.
void add_bench(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_doctor(CLI::App& app, int& exit_code);
void add_graph(CLI::App& app, int& exit_code);
void add_messages(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code);
void add_schema(CLI::App& app, int& exit_code);
void add_tasks(CLI::App& app, int& exit_code);
void add_vehicle(CLI::App& app, int& exit_code);

}  // namespace jarol::tools
