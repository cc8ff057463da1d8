#include "tools/console/options.h"

#include <charconv>
#include <iostream>

#include "distributers/session/pace.h"
#include "graph/text/errors.h"
#include "tools/report/command_line.h"

namespace jarol::tools {

void add_console_options(Command& command, ConsoleArguments& arguments) {
  command.add_flag_with_value(
      "--console", arguments.port, "PORT",
      "Show the run on a web page, whose address is printed: --console, or --console=8080 for a port of your choice; "
      "on the virtual clock it goes at --pace 1 unless that says otherwise");
  command.add_option("--console-listen", arguments.listen,
                     "The address that the page is served on; default 127.0.0.1, this machine alone");
  command.add_option("--pace", arguments.pace,
                     "The virtual clock beside the wall clock: 1, 0.1, 10, or max, which is the default without "
                     "--console: as fast as possible");
}

void add_server_options(Command& command, ConsoleArguments& arguments) {
  arguments.port = "true";
  command.add_option("--port", arguments.port, "The port of the page; default: any that is free");
  command.add_option("--listen", arguments.listen,
                     "The address that the page is served on; default 127.0.0.1, this machine alone");
}

void require_effect(const Command& command, const ConsoleArguments& arguments, bool virtual_clock) {
  if (!arguments.wanted()) command.refuse({"--console-listen"}, "belongs to --console; add that, or leave it out");
  if (!virtual_clock) command.refuse({"--pace"}, "belongs to the virtual clock; the real one has its own");
}

std::optional<double> parse_pace(const std::string& text) {
  if (text == "max") return std::nullopt;
  double speed = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, speed);
  if (read.ec != std::errc() || read.ptr != end || !(speed >= Pace::min && speed <= Pace::max))
    throw InputError("--pace: '" + text + "' is no number from 0.001 to 1000, nor max; write it as in 1, 0.1 or 10");
  return speed;
}

console::ServerOptions server_of(const ConsoleArguments& arguments) {
  console::ServerOptions options{.listen = arguments.listen};
  const std::string& port = arguments.port;
  if (port == "true") return options;
  const auto read = std::from_chars(port.data(), port.data() + port.size(), options.port);
  if (read.ec != std::errc() || read.ptr != port.data() + port.size() || options.port < 1 || options.port > 65535)
    throw InputError("the console's port '" + port + "' is no number from 1 to 65535");
  return options;
}

void print_url(const std::string& url, const ConsoleArguments& arguments) {
  std::cerr << "console: " << url << std::endl;
  const bool all = arguments.listen.find_first_not_of("0.:") == std::string::npos;
  if (all) std::cerr << "  where that name is not known, put an address of this machine in its place" << std::endl;
}

}  // namespace jarol::tools
