#include "tests/tools/process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <deque>
#include <mutex>
#include <stdexcept>

#include "distributers/links/address.h"

namespace jarol::tests {

using distributers::Address;
using distributers::Descriptor;

namespace {
// A process that is being made has whatever is open here until it runs its own program: no probe of a port may be.
std::mutex making;
}  // namespace

Process::Process(const std::string& arguments) {
  // the shell splits the arguments and gives its place to the command
  std::string line = std::string("exec ") + JAROL_COMMAND + " " + arguments;
  std::array<char*, 4> words{const_cast<char*>("sh"), const_cast<char*>("-c"), line.data(), nullptr};
  int out[2], err[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
  // whatever is ignored here, as under nohup
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigfillset(&signals);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  std::unique_lock lock(making);
  const int failed = posix_spawn(&id_, "/bin/sh", &actions, &attributes, words.data(), environ);
  lock.unlock();
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(out[1]);
  close(err[1]);
  out_ = std::thread([this, fd = out[0]] { read(fd, output_); });
  err_ = std::thread([this, fd = err[0]] { read(fd, errors_); });
  if (failed != 0) id_ = -1;
}

Process::~Process() {
  if (id_ > 0) kill();
  end();
}

void Process::read(int fd, std::string& to) {
  const Descriptor pipe(fd);
  std::array<char, 4096> room{};
  for (ssize_t length = 0; (length = ::read(fd, room.data(), room.size())) > 0;) {
    const std::lock_guard lock(mutex_);
    to.append(room.data(), static_cast<std::size_t>(length));
  }
}

void Process::kill() { ::kill(id_, SIGKILL); }

void Process::interrupt() { signal(SIGINT); }

void Process::signal(int number) { ::kill(id_, number); }

bool Process::runs() {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
}

bool Process::says(const std::string& text, std::chrono::seconds patience) {
  return await(patience, [&] { return errors_.find(text) != std::string::npos; });
}

std::string Process::rest_of_line(const std::string& text, std::chrono::seconds patience) {
  std::string rest;
  await(patience, [&] {
    const std::size_t at = errors_.find(text), end = errors_.find('\n', at);
    if (at == std::string::npos || end == std::string::npos) return false;
    rest = errors_.substr(at + text.size(), end - at - text.size());
    return true;
  });
  return rest;
}

// Looks at what it said so far, again and again.
bool Process::await(std::chrono::seconds patience, const std::function<bool()>& there) {
  for (const auto end = std::chrono::steady_clock::now() + patience; std::chrono::steady_clock::now() < end;) {
    {
      const std::lock_guard lock(mutex_);
      if (there()) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

int Process::end() {
  if (id_ > 0) {
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  if (out_.joinable()) out_.join();
  if (err_.joinable()) err_.join();
  return exit_code_;
}

namespace {

// No other process of tests gets the port until this one has asked for many more, or has ended: a name in the system,
// which goes with its socket.
bool reserve(const std::string& port) {
  static std::mutex mutex;
  static std::deque<Descriptor> held;
  constexpr std::size_t max = 64;
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  const std::string text = "jarol test port " + port;
  text.copy(name.sun_path + 1, sizeof name.sun_path - 1);  // behind a zero: a name, and no file
  Descriptor mark(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (bind(mark.get(), reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0) return false;
  const std::lock_guard lock(mutex);
  held.push_back(std::move(mark));
  if (held.size() > max) held.pop_front();
  return true;
}

}  // namespace

std::string free_port(int type) {
  constexpr int first = 10'000, count = 20'000;
  static std::atomic<int> next{static_cast<int>(getpid()) * 16};
  for (int i = 0; i < count; ++i) {
    const std::string port = std::to_string(first + next++ % count);
    const std::lock_guard lock(making);
    const Descriptor probe(socket(AF_INET, type | SOCK_CLOEXEC, 0));  // not for a process made meanwhile
    const Address address = Address::parse(port);
    if (bind(probe.get(), address.get(), address.size()) == 0 && reserve(port)) return port;
  }
  throw std::runtime_error("no free port");
}

}  // namespace jarol::tests
