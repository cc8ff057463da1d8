// The command `jarol`.
#include <fcntl.h>

#include <algorithm>
#include <iostream>
#include <new>

#include "graph/yaml/problems.h"
#include "tools/command_line.h"
#include "tools/commands/commands.h"

namespace {
using namespace jarol;

// A stream that was closed fails to read or write; no file that is opened later takes its place.
void keep_standard_streams() {
  for (const int stream : {0, 1, 2})
    if (::fcntl(stream, F_GETFD) == -1 && ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY) == -1) return;
}

int run_command(int argc, char** argv) {
  tools::CommandLine line(
      "jarol",
      "Jarol runs control programs that are graphs of isolated tasks: checked for schedulability, the same to the bit "
      "every time.\n\n  jarol check specs/exolauv.yaml     can it be scheduled, and if not, why\n"
      "  jarol run specs/exolauv.yaml       run it on the virtual clock\n"
      "  jarol tasks                        what a graph can be made of\n",
      JAROL_VERSION);
  int exit_code = tools::exit_good;
  tools::add_bench(line, exit_code);
  tools::add_check(line, exit_code);
  tools::add_doctor(line, exit_code);
  tools::add_graph(line, exit_code);
  tools::add_messages(line, exit_code);
  tools::add_replay(line, exit_code);
  tools::add_run(line, exit_code);
  tools::add_schema(line, exit_code);
  tools::add_tasks(line, exit_code);
  tools::add_vehicle(line, exit_code);
  // a mistyped command gets a suggestion
  const std::vector<std::string> names = line.names();
  if (argc > 1 && argv[1][0] != '-' && std::find(names.begin(), names.end(), argv[1]) == names.end()) {
    std::cerr << "error: there is no command '" << argv[1] << "'" << did_you_mean(argv[1], names)
              << "; there are: " << list_of(names) << "\n";
    return tools::exit_input;
  }
  try {
    return line.parse(argc, argv) ? exit_code : tools::exit_input;
  } catch (const SpecError& error) {
    std::cerr << error.what() << "\n";
    const std::size_t count = error.problems().size();
    std::cerr << count << (count == 1 ? " error\n" : " errors\n");
    return tools::exit_input;
  } catch (const std::bad_alloc&) {
    std::cerr << "error: there is not enough memory for this\n";
    return tools::exit_unfinished;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return tools::exit_input;
  }
}

}  // namespace

int main(int argc, char** argv) {
  keep_standard_streams();
  const int exit_code = run_command(argc, argv);
  if (std::cout.flush()) return exit_code;
  std::cerr << "error: can't write to stdout, what stands there is not whole; is the disk full, or stdout closed?\n";
  return tools::exit_unfinished;
}
