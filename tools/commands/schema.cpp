// jarol schema: the JSON Schema of the graph language.
#include <iostream>

#include "tools/commands/commands.h"
#include "tools/library/built_in.h"
#include "tools/report/command_line.h"
#include "tools/report/graph_schema.h"

namespace jarol::tools {

void add_schema(CommandLine& line, int& exit_code) {
  Command* command =
      line.add_subcommand("schema",
                          "Print the JSON Schema of graphs, for editors: jarol schema > specs/graph.schema.json.\n"
                          "A file names it in its first line: # yaml-language-server: $schema=graph.schema.json");
  command->callback([&exit_code] {
    std::cout << graph_schema(built_in());
    exit_code = exit_good;
  });
}

}  // namespace jarol::tools
