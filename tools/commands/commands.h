// The subcommands of `jarol`, a file each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "graph/language/duration.h"
#include "tools/report/exit_code.h"

namespace jarol {
class Pace;
struct Loaded;
}  // namespace jarol

namespace jarol::tools {

class CommandLine;
struct RunArguments;
namespace console {
class View;
}

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
/// Makes the page that shows a run (run/watch_run.h).
using WatchRun = std::unique_ptr<console::View>(const RunArguments&, const Loaded&, Duration until, Pace*);
void add_run(CommandLine& line, int& exit_code, WatchRun* watch);
void add_schema(CommandLine& line, int& exit_code);
void add_tasks(CommandLine& line, int& exit_code);
void add_vehicle(CommandLine& line, int& exit_code);

/// What `jarol` is, without subcommands; `more` is said about these.
CommandLine make_bare_command_line(const std::string& more = "");

/// All that are built: each of them (commands.cpp), or the first ones (first.cpp).
CommandLine make_command_line(int& exit_code);
/// Names of those that are not built yet.
std::vector<std::string> unbuilt_commands();

}  // namespace jarol::tools
