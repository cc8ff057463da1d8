// The command `jarol`.
#include <CLI/CLI.hpp>
#include <iostream>

#include "graph/yaml/problems.h"
#include "tools/commands/commands.h"

int main(int argc, char** argv) {
  using namespace jarol;
  CLI::App app{
      "Jarol runs control programs that are graphs of isolated tasks: checked for schedulability, the same to the bit "
      "every time.\n\n  jarol check specs/exolauv.yaml     can it be scheduled, and if not, why\n"
      "  jarol run specs/exolauv.yaml       run it on the virtual clock\n"
      "  jarol tasks                        what a graph can be made of\n",
      "jarol"};
  app.require_subcommand(1);
  app.set_version_flag("--version", JAROL_VERSION);
  int exit_code = tools::exit_good;
  tools::add_bench(app, exit_code);
  tools::add_check(app, exit_code);
  tools::add_doctor(app, exit_code);
  tools::add_graph(app, exit_code);
  tools::add_messages(app, exit_code);
  tools::add_run(app, exit_code);
  tools::add_schema(app, exit_code);
  tools::add_tasks(app, exit_code);
  tools::add_vehicle(app, exit_code);
  // a mistyped command gets a suggestion
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::find(names.begin(), names.end(), argv[1]) == names.end()) {
    std::cerr << "error: there is no command '" << argv[1] << "'" << did_you_mean(argv[1], names)
              << "; there are: " << list_of(names) << "\n";
    return tools::exit_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? tools::exit_good : tools::exit_input;
  } catch (const SpecError& error) {
    std::cerr << error.what() << "\n";
    const std::size_t count = error.problems().size();
    std::cerr << count << (count == 1 ? " error\n" : " errors\n");
    return tools::exit_input;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return tools::exit_input;
  }
  return exit_code;
}
