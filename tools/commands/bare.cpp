#include "tools/commands/commands.h"
#include "tools/report/command_line.h"
#include "tools/report/version.h"

namespace jarol::tools {

CommandLine make_bare_command_line(const std::string& more) {
  return CommandLine(
      "jarol",
      "Jarol runs control programs that are graphs of isolated tasks: checked for schedulability, the same to the bit "
      "every time.\n\n  jarol check specs/exolauv.yaml     can it be scheduled, and if not, why\n"
      "  jarol run specs/exolauv.yaml       run it on the virtual clock\n"
      "  jarol tasks                        what a graph can be made of\n"
      "  jarol help run                     all about a command\n" +
          more,
      version_text());
}

}  // namespace jarol::tools
