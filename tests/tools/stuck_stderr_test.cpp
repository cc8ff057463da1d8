// Runs that end while nobody reads what they say or report: a pipe that is full.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include "distributers/links/address.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using namespace std::chrono_literals;
using jarol::distributers::Address;
using jarol::distributers::Descriptor;

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    from = Descriptor(ends[0]);
    to = Descriptor(ends[1]);
  }
  void fill() const {
    // opened anew, so that only here nothing blocks
    const Descriptor here(open(("/proc/self/fd/" + std::to_string(to.get())).c_str(), O_WRONLY | O_NONBLOCK));
    const std::string block(4096, '.');
    while (write(here.get(), block.data(), block.size()) > 0) {}
    while (write(here.get(), ".", 1) > 0) {}
  }
  Descriptor from, to;
};

bool has_something(int fd, std::chrono::milliseconds patience) {
  pollfd one{fd, POLLIN, 0};
  return poll(&one, 1, static_cast<int>(patience.count())) == 1 && (one.revents & POLLIN) != 0;
}

// A run that steers what is not there, and never comes to rest; from its first command on its stderr is full.
class StuckRun {
 public:
  explicit StuckRun(const std::string& more = "") {
    const std::string port = jarol::tests::free_port(SOCK_DGRAM);
    const Descriptor vehicle(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const Address address = Address::parse(port);
    REQUIRE(bind(vehicle.get(), address.get(), address.size()) == 0);
    const std::string script = folder_.write(
        "deep.csv", "time,setpoint.depth,setpoint.heading,setpoint.speed\n0,3,0deg,1.2\n600,3,0deg,1.2\n");
    std::string line = std::string("exec ") + JAROL_COMMAND +
                       " run specs/exolauv.yaml --clock real --for 1h --set expect=nothing --set fault_limit=100%"
                       " --set 'at_end.until=navigation.motion.z < -100' --set at_end.longest=1s --set "
                       "distributers.neptus.link.file=" +
                       script + " --set 'distributers.dune.link={type: udp, peer: " + port +
                       ", id: 16385, source: 0x00D1}' " + more;
    std::array<char*, 4> words{const_cast<char*>("sh"), const_cast<char*>("-c"), line.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, out_.to.get(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err_.to.get(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    REQUIRE(posix_spawn(&id_, "/bin/sh", &actions, &attributes, words.data(), environ) == 0);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    REQUIRE(has_something(vehicle.get(), 60s));
    err_.fill();
  }
  ~StuckRun() {
    if (id_ <= 0) return;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  StuckRun(const StuckRun&) = delete;
  StuckRun& operator=(const StuckRun&) = delete;

  void fill_stdout() const { out_.fill(); }
  void interrupt() const { kill(id_, SIGINT); }
  // what it has printed once it prints that; empty: it does not come
  std::string report_with(const std::string& words) {
    std::string text;
    while (text.find(words) == std::string::npos) {
      if (!has_something(out_.from.get(), 20s)) return "";
      std::array<char, 4096> room{};
      const ssize_t length = read(out_.from.get(), room.data(), room.size());
      if (length <= 0) return "";
      text.append(room.data(), static_cast<std::size_t>(length));
    }
    return text;
  }
  // the signal that ended it; 0: it goes on, or ended otherwise
  int ended_by() {
    for (const auto until = std::chrono::steady_clock::now() + 10s; std::chrono::steady_clock::now() < until;) {
      int status = 0;
      if (waitpid(id_, &status, WNOHANG) == id_) {
        id_ = -1;
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
      }
      std::this_thread::sleep_for(10ms);
    }
    return 0;
  }

 private:
  command::TemporaryFolder folder_;
  Pipe out_, err_;
  pid_t id_ = -1;
};
}  // namespace

TEST_SUITE("tools/commands/run/stuck_stderr") {
  TEST_CASE("a vehicle is brought to rest for no longer than it may take while nobody reads stderr") {
    for (const char* more : {"", "--concurrency threads"}) {
      CAPTURE(more);
      StuckRun run(more);
      run.interrupt();
      const std::string report = run.report_with("NOT AT REST");
      CHECK(report.find("NOT AT REST after 1") != std::string::npos);
    }
  }

  TEST_CASE("a run whose report nobody reads ends by the first signal all the same, a second after it is at rest") {
    for (const char* more : {"", "--concurrency threads"}) {
      CAPTURE(more);
      StuckRun run(more);
      run.fill_stdout();
      run.interrupt();
      CHECK(run.ended_by() == SIGINT);
    }
  }

  TEST_CASE("once rest is over a second signal ends a run that is stuck, whose line nobody reads") {
    StuckRun run;
    run.interrupt();
    CHECK(run.report_with("NOT AT REST") != "");
    std::this_thread::sleep_for(600ms);  // as a hand does
    run.interrupt();
    CHECK(run.ended_by() == SIGINT);
  }
}
