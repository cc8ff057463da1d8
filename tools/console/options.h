// The options of runs that people watch on a page.
#pragma once

#include <optional>
#include <string>

#include "tools/console/server.h"

namespace jarol::tools {

class Command;

struct ConsoleArguments {
  std::string port;  // empty: there is no console; "true": any port
  std::string listen = "127.0.0.1";
  std::string pace;  // empty: as --console has it

  bool wanted() const { return !port.empty(); }
};

/// Of a run.
void add_console_options(Command& command, ConsoleArguments& arguments);
/// Where nothing but a page is wanted.
void add_server_options(Command& command, ConsoleArguments& arguments);
/// Refuses those that would have no effect. Throws InputError.
void require_effect(const Command& command, const ConsoleArguments& arguments, bool virtual_clock);

/// What --pace says, as in 1, 0.1, 10 or max. Throws InputError.
std::optional<double> parse_pace(const std::string& text);

console::ServerOptions server_of(const ConsoleArguments& arguments);

/// A line that says where the page is, on stderr, at once; where it is served on all addresses another one.
void print_url(const std::string& url, const ConsoleArguments& arguments);

}  // namespace jarol::tools
