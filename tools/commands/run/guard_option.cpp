#include "tools/commands/run/guard_option.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <system_error>

#include "graph/text/errors.h"
#include "graph/text/escape.h"
#include "tools/report/command_line.h"

namespace jarol::tools {

void add_guard_option(Command& command, bool& guard) {
  command.add_flag("--guard", guard,
                   "On the virtual clock: a task that writes to memory that is not its own ends the run, with its name "
                   "and the address; takes some 0.8 ms for each activation");
}

void require_guard_effect(const Command& command, bool guard, bool virtual_clock) {
  if (!guard) return;
  if (!virtual_clock) throw InputError("--guard belongs to the virtual clock: pages are protected for all threads");
  command.refuse({"--workers"},
                 "does not go with --guard: pages are protected for all threads, and one task runs at a time");
  command.refuse({"--console"}, "does not go with --guard: the page's server reads into memory while tasks run");
  command.refuse({"--what-if"}, "does not go with --guard; leave out one of them");
}

void look_up_at_once() {
  constexpr const char* variable = "LD_BIND_NOW";
  if (std::getenv(variable) != nullptr) return;
  ::setenv(variable, "1", 1);
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::string words(std::istreambuf_iterator<char>(in), {});
  std::vector<char*> arguments;
  for (std::size_t at = 0; at < words.size(); at = words.find('\0', at) + 1) arguments.push_back(&words[at]);
  arguments.push_back(nullptr);
  ::execv("/proc/self/exe", arguments.data());
  throw Unfinished("--guard: the program can't be begun again: " + std::generic_category().message(errno));
}

std::unique_ptr<TaskGuard> make_guard(bool wanted, const Graph& graph, const std::vector<ExternalSystem*>& systems) {
  if (!wanted) return nullptr;
  for (std::size_t i = 0; i < systems.size(); ++i)
    if (systems[i]->outlives_run())
      throw InputError("--guard: distributer '" + printable(graph.distributers[i].name) +
                       "' has a link to another process, which reads into memory while tasks run; state a "
                       "link to a vehicle in this one");
  try {
    return std::make_unique<TaskGuard>();
  } catch (const Unfinished& refused) { throw InputError(std::string("--guard: ") + refused.what()); }
}

}  // namespace jarol::tools

// In the place of the C++ library's: what is thrown lies in memory of the whole process, and so does how far it has
// come. From the first exception on to the end of the last one the guard is open.
extern "C" {
void* __cxa_allocate_exception(std::size_t size) noexcept {
  jarol::PageGuard::suspend();
  static const auto theirs = reinterpret_cast<void* (*)(std::size_t)>(::dlsym(RTLD_NEXT, "__cxa_allocate_exception"));
  return theirs(size);
}
void __cxa_end_catch() {
  static const auto theirs = reinterpret_cast<void (*)()>(::dlsym(RTLD_NEXT, "__cxa_end_catch"));
  theirs();
  if (jarol::PageGuard::is_suspended() && std::uncaught_exceptions() == 0 && !std::current_exception())
    jarol::PageGuard::resume();
}
}
