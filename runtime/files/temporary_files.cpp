#include "runtime/files/temporary_files.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>

namespace jarol {
namespace {

// Plain memory, since a signal may come at any moment.
struct Partial {
  std::atomic<bool> there{false};
  std::array<char, 4096> path{};
};
std::array<Partial, 8> partials;

extern "C" void end(int signal) {
  remove_temporary_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void add_temporary_file(const std::string& path) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXFSZ}) {
    struct sigaction now {};
    if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_DFL) std::signal(signal, end);
  }
  for (Partial& partial : partials) {
    if (partial.there.load() || path.size() >= partial.path.size()) continue;
    std::memcpy(partial.path.data(), path.c_str(), path.size() + 1);
    partial.there.store(true);
    return;
  }
}

void drop_temporary_file(const std::string& path) {
  for (Partial& partial : partials)
    if (partial.there.load() && path == partial.path.data()) partial.there.store(false);
}

void remove_temporary_files() {
  for (const Partial& partial : partials)
    if (partial.there.load()) ::unlink(partial.path.data());
}

}  // namespace jarol
