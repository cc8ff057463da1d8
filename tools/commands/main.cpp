// The command `jarol`.
#include <fcntl.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "distributers/guardian/guardian_process.h"
#include "graph/language/inputs.h"
#include "graph/language/problems.h"
#include "graph/plugins/plugins.h"
#include "graph/text/errors.h"
#include "tools/commands/commands.h"
#include "tools/commands/run/crash_line.h"
#include "tools/report/command_line.h"
#include "tools/report/failure.h"
#include "tools/report/printable_stream.h"

namespace {
using namespace jarol;

// A stream that was closed fails to read or write; no file that is opened later takes its place.
void keep_standard_streams() {
  for (const int stream : {0, 1, 2})
    if (::fcntl(stream, F_GETFD) == -1 && ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY) == -1) return;
}

// What runs over a stack so small does so before a crash can be reported.
void require_stack() {
  constexpr rlim_t least = 256 << 10;
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur < least)
    throw Unfinished("the stack is limited to " + std::to_string(stack.rlim_cur >> 10) +
                     " KiB; it needs 256 KiB, as 'ulimit -s 256' gives it");
}

// "jarol help" and "jarol help run" ask for what "jarol --help" and "jarol run --help" do.
std::vector<char*> asked_of(int argc, char** argv) {
  static std::string help = "--help";
  if (std::string_view(argv[1]) != "help") return {argv, argv + argc};
  if (argc == 2) return {argv[0], help.data()};
  return {argv[0], argv[2], help.data()};
}

// A mistyped command gets a suggestion.
void expect_command(const std::string& word, std::vector<std::string> names) {
  const std::vector<std::string> unbuilt = tools::unbuilt_commands();
  if (std::find(unbuilt.begin(), unbuilt.end(), word) != unbuilt.end())
    throw tools::UsageError("the command '" + word + "' is not built yet; tools/build builds all commands");
  names.push_back("help");
  std::sort(names.begin(), names.end());
  if (!word.starts_with('-') && std::find(names.begin(), names.end(), word) == names.end())
    throw tools::UsageError("there is no command '" + word + "'" + did_you_mean(word, names) +
                            "; there are: " + list_of(names));
}

int run_command(int argc, char** argv) {
  int exit_code = tools::exit_good;
  tools::CommandLine line = tools::make_command_line(exit_code);
  try {
    require_stack();
    if (argc == 1) {
      std::cout << line.help();
      return tools::exit_input;
    }
    std::vector<char*> words = asked_of(argc, argv);
    if (words.size() > 1) expect_command(words[1], line.names());
    line.parse(static_cast<int>(words.size()), words.data());
    return exit_code;
  } catch (...) { return tools::report(tools::failure_of(std::current_exception()), line.asks_for_json(argc, argv)); }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1 && distributers::is_guardian(argv[0])) return distributers::run_guardian();
  keep_standard_streams();
  // what it writes must not take its own place
  std::error_code none;
  note_input(std::filesystem::read_symlink("/proc/self/exe", none).string());
  const tools::PrintableStream out(std::cout), errors(std::cerr);
  int exit_code = run_command(argc, argv);
  if (!std::cout.flush()) {
    std::cerr << "error: can't write to stdout, what stands there is not whole; is the disk full, or stdout closed?\n";
    exit_code = tools::exit_unfinished;
  }
  // destructors of a plugin's static objects might do anything: hang, crash, or end the process with another code
  if (are_plugins_loaded()) tools::end_at_once(exit_code);
  return exit_code;
}
