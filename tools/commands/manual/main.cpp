// Writes the man pages and the completion for bash: jarol_manual FOLDER.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "tools/commands/commands.h"
#include "tools/commands/manual/completion.h"
#include "tools/commands/manual/man_page.h"
#include "tools/report/command_line.h"

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << text).flush()) throw std::runtime_error("can't write '" + path.string() + "'");
}

}  // namespace

int main(int argc, char** argv) {
  using namespace jarol::tools;
  if (argc != 2) {
    std::cerr << "usage: jarol_manual FOLDER\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    int exit_code = 0;
    const CommandLine line = make_command_line(exit_code);
    const std::vector<CommandText> commands = line.describe();
    write(folder / "jarol.1", man_page(line.text(), commands, JAROL_VERSION));
    for (const CommandText& command : commands)
      write(folder / ("jarol-" + command.name + ".1"), man_page(command, JAROL_VERSION));
    write(folder / "jarol", bash_completion(commands));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 2;
  }
}
