#include "graph/plugins/plugin_trial.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <initializer_list>

#include "graph/floating_point.h"
#include "graph/plugins/plugins.h"

namespace jarol {
namespace {

constexpr std::chrono::seconds patience{5};

int report_to = -1;  // in the trial's process
pid_t trial = 0;

[[noreturn]] void end_trial(const std::string& report) {
  if (getpid() != trial) _exit(0);  // a process that the library started, and that would go on as this one
  // what does not fit is lost, no more
  [[maybe_unused]] const ssize_t written = write(report_to, report.data(), report.size());
  _exit(0);
}

// What a static constructor throws passes dlopen as an exception that nobody catches.
[[noreturn]] void on_terminate() {
  if (const std::exception_ptr thrown = std::current_exception()) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::exception& error) {
      end_trial(std::string("throws when it is loaded: ") + error.what());
    } catch (...) { end_trial("throws when it is loaded"); }
  }
  end_trial("calls std::terminate when it is loaded");
}

[[noreturn]] void run_trial(const std::string& path, pid_t starter) {
  // what does not end to load does not outlive a program that was ended meanwhile
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != starter) _exit(0);
  for (const int number : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTERM, SIGINT, SIGALRM}) signal(number, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  std::set_terminate(on_terminate);
  set_floating_point_control(default_floating_point_control());
  try {
    PluginLibrary library;
    const std::string wrong = open_plugin(path, library);
    if (!wrong.empty()) end_trial(wrong);
    if (const std::string difference = describe_difference(floating_point_control()); !difference.empty())
      end_trial("leaves another floating-point environment behind when it is loaded (" + difference +
                "), as what is linked with -ffast-math does; link it without");
    PluginParts added;
    library.add(added);
    if (waitpid(-1, nullptr, WNOHANG) >= 0) end_trial("starts a process when it is loaded");
  } catch (const std::exception& error) {
    end_trial(std::string("throws when it is loaded: ") + error.what());
  } catch (...) { end_trial("throws when it is loaded"); }
  end_trial("good");
}

// All that comes until the other end is closed; false: that took too long.
bool read_all(int from, std::string& text) {
  const auto end = std::chrono::steady_clock::now() + patience;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd ready{from, POLLIN, 0};
    const int found = left.count() > 0 ? poll(&ready, 1, static_cast<int>(left.count())) : 0;
    if (found < 0 && errno == EINTR) continue;
    if (found <= 0) return false;
    char piece[512];
    const ssize_t count = read(from, piece, sizeof piece);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    text.append(piece, static_cast<std::size_t>(count));
  }
}

}  // namespace

std::string try_plugin(const std::string& path) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::string("can't be tried: ") + std::strerror(errno);
  const pid_t starter = getpid();
  const pid_t child = fork();
  if (child < 0) {
    const int why = errno;
    close(ends[0]);
    close(ends[1]);
    return std::string("can't be tried: ") + std::strerror(why);
  }
  if (child == 0) {
    report_to = ends[1];
    trial = getpid();
    close(ends[0]);
    run_trial(path, starter);
  }
  close(ends[1]);
  std::string report;
  const bool ended = read_all(ends[0], report);
  close(ends[0]);
  if (!ended) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  if (!ended)
    return "does not end to load within " + std::to_string(patience.count()) + " s; look at its static objects";
  if (WIFSIGNALED(status)) return std::string("ends the process when it is loaded: ") + strsignal(WTERMSIG(status));
  if (report.empty())
    return "ends the process when it is loaded, with exit code " + std::to_string(WEXITSTATUS(status));
  return report == "good" ? "" : report;
}

}  // namespace jarol
