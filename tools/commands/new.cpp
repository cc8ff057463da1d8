// jarol new: a project of one's own.
#include <iostream>
#include <memory>

#include "graph/text/escape.h"
#include "tools/commands/commands.h"
#include "tools/commands/new/make_project.h"
#include "tools/report/command_line.h"
#include "tools/report/exit_code.h"

namespace jarol::tools {
namespace {

struct NewOptions {
  std::string folder;
  bool vehicle = false;
};

int make(const NewOptions& options) {
  const auto files = make_project(options.folder, options.vehicle ? "rover" : "base");
  const std::string folder = printable(options.folder);
  std::cout << "made '" << folder << "' with\n";
  for (const std::string& file : files) std::cout << "  " << file << "\n";
  std::cout << "next: cd " << folder << " && cmake -B build && cmake --build build && ctest --test-dir build\n";
  return exit_good;
}

}  // namespace

void add_new(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<NewOptions>();
  Command* command = line.add_subcommand(
      "new", "Make a project of one's own: a task, a graph, tests, built by CMake with find_package(jarol)");
  command->add_option("DIR", options->folder, "The folder to make; its name is the project's")->folder()->required();
  command->add_flag("--vehicle", options->vehicle,
                    "With a simulated vehicle, a rover, its message set and its distributer");
  command->callback([options, &exit_code] { exit_code = make(*options); });
}

}  // namespace jarol::tools
