#include "tools/commands/run/no_plugins.h"

#include "tools/report/command_line.h"

namespace jarol::tools {

void add_no_plugins(Command& command, Overrides& overrides) {
  command.add_flag(
      "--no-plugins", [&overrides] { overrides.no_plugins = "--no-plugins refuses it; leave that out, or the plugin"; },
      "Refuse a graph that names plugins, and load none");
}

}  // namespace jarol::tools
