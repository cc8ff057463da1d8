// jarol schema: the JSON Schema of the graph language.
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "tools/commands/commands.h"
#include "tools/commands/run/known_with.h"
#include "tools/report/command_line.h"
#include "tools/report/graph_schema.h"

namespace jarol::tools {

void add_schema(CommandLine& line, int& exit_code) {
  auto plugins = std::make_shared<std::vector<std::string>>();
  Command* command =
      line.add_subcommand("schema",
                          "Print the JSON Schema of graphs, for editors: jarol schema > specs/graph.schema.json.\n"
                          "A file names it in its first line: # yaml-language-server: $schema=graph.schema.json");
  command->add_option("--plugin", *plugins, "Also what this shared library brings")->file({"so"})->one_value();
  command->callback([plugins, &exit_code] {
    std::cout << graph_schema(known_with(*plugins));
    exit_code = exit_good;
  });
}

}  // namespace jarol::tools
