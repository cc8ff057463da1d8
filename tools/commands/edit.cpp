// jarol edit: a graph's file on a web page.
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <thread>

#include "graph/text/errors.h"
#include "tools/commands/commands.h"
#include "tools/commands/edit/editor.h"
#include "tools/commands/run/interrupt.h"
#include "tools/commands/run/no_plugins.h"
#include "tools/console/options.h"
#include "tools/report/command_line.h"

namespace jarol::tools {
namespace {

struct EditOptions {
  std::string file;
  Overrides overrides;
  ConsoleArguments console;
};

int edit_graph(const EditOptions& options) {
  if (options.file == "-") throw InputError("'-' is stdin, which can't be written; name the graph's file");
  if (std::filesystem::is_other(options.file))
    throw InputError("'" + options.file + "' is no regular file, which can't be saved; name the graph's file");
  const Interruptible interruptible;
  const edit::Editor editor({.file = options.file,
                             .program = std::filesystem::read_symlink("/proc/self/exe"),
                             .profile = options.overrides.profile,
                             .no_plugins = options.overrides.no_plugins,
                             .server = server_of(options.console)});
  print_url(editor.url(), options.console);
  // until Ctrl-C
  while (Interruptible::signal() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return exit_of_signal(Interruptible::signal());
}

}  // namespace

void add_edit(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<EditOptions>();
  Command* command = line.add_subcommand(
      "edit",
      "Edit a graph on a web page, whose address is printed: its drawing, forms, and its text beside them, in which "
      "each\n"
      "edit changes as little as can be; with what the loader and jarol check say of it. Ctrl-C ends it.\n"
      "Exit code: 2 bad input, 129, 130, 143 ended by SIGHUP, SIGINT (Ctrl-C), SIGTERM");
  command->add_option("FILE", options->file, "The graph, a YAML file")->file({"yaml"})->required();
  command->add_option("--profile", options->overrides.profile,
                      "Begin with the verdict on this profile of the file; the text is the whole file's");
  add_no_plugins(*command, options->overrides);
  add_server_options(*command, options->console);
  command->callback([options, &exit_code] { exit_code = edit_graph(*options); });
}

}  // namespace jarol::tools
