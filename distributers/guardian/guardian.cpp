#include "distributers/guardian/guardian.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "distributers/guardian/guardian_process.h"
#include "distributers/guardian/stamped_packet.h"
#include "distributers/guardian/words.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

constexpr int patience_to_begin = 5000;  // ms, for it to begin
constexpr int patience_to_end = 1000;    // ms, for it to end

std::span<const std::byte> bytes_of(const auto& value) { return std::as_bytes(std::span(&value, 1)); }

bool is_ready(int socket, int patience_ms) {
  pollfd polled{socket, POLLIN, 0};
  int ready = 0;
  do ready = poll(&polled, 1, patience_ms);
  while (ready < 0 && errno == EINTR);
  return ready > 0;
}

// What posix_spawn is to do: in a session of its own, so that no signal to a group or from a terminal reaches it, and
// with all signals blocked from its first instruction on.
struct SpawnOptions {
  SpawnOptions() {
    posix_spawnattr_init(&attributes);
    sigset_t all;
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
    posix_spawn_file_actions_init(&actions);
  }
  ~SpawnOptions() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }
  SpawnOptions(const SpawnOptions&) = delete;
  SpawnOptions& operator=(const SpawnOptions&) = delete;

  posix_spawnattr_t attributes;
  posix_spawn_file_actions_t actions;
};

}  // namespace

Guardian::Guardian(const std::string& program) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    throw Unfinished(std::string("no pair of sockets: ") + std::strerror(errno));
  socket_ = Descriptor(ends[0]);
  // not where it has to be: a descriptor that is moved to its own place would be closed there
  const Descriptor there(fcntl(ends[1], F_DUPFD_CLOEXEC, guardian_socket + 1));
  ::close(ends[1]);
  SpawnOptions options;
  posix_spawn_file_actions_adddup2(&options.actions, there.get(), guardian_socket);
  std::string name = guardian_name;
  const std::array<char*, 2> words{name.data(), nullptr};
  const int failed =
      posix_spawn(&process_, program.c_str(), &options.actions, &options.attributes, words.data(), environ);
  if (failed == 0) return;
  process_ = -1;
  throw Unfinished("'" + program + "' does not start: " + std::strerror(failed));
}

Guardian::~Guardian() { end(); }

Holder* Guardian::add(const messages::MessageSet& set, const std::string& text,
                      std::span<const std::vector<std::byte>> packets, const GuardianKey* key) {
  const auto link = static_cast<std::uint32_t>(holders_.size());
  const Stamping stamping = stamping_of(set);
  const auto descriptor = bytes_of(stamping), name = std::as_bytes(std::span(text));
  std::vector<std::byte> words(descriptor.begin(), descriptor.end());
  words.insert(words.end(), name.begin(), name.end());
  said_all_ &= say(socket_.get(), {Word::link, link}, words);
  if (key != nullptr) said_all_ &= say(socket_.get(), {Word::key, link}, bytes_of(*key));
  for (const std::vector<std::byte>& packet : packets) said_all_ &= say(socket_.get(), {Word::packet, link}, packet);
  return &holders_.emplace_back(*this, link);
}

void Guardian::await_ready(std::optional<int> priority) {
  const Urgency urgency{priority.value_or(0)};
  said_all_ &= say(socket_.get(), {Word::ready, 0}, bytes_of(urgency));
  std::array<std::byte, sizeof(Sentence)> room;
  if (!said_all_ || !is_ready(socket_.get(), patience_to_begin) || !hear(socket_.get(), room))
    throw Unfinished("its process does not answer");
}

void Guardian::arm() const { say(socket_.get(), {Word::armed, 0}); }

bool Guardian::close() {
  if (process_ < 0) return true;
  const bool was_there = say(socket_.get(), {Word::closed, 0});
  return end() && was_there;
}

bool Guardian::is_gone() const {
  pollfd its{socket_.get(), 0, 0};
  return process_ >= 0 && ::poll(&its, 1, 0) == 1 && (its.revents & (POLLHUP | POLLERR)) != 0;
}

void Guardian::wake() const { say(socket_.get(), {Word::crashed, 0}); }

// Its end of the sockets goes with it.
bool Guardian::end() {
  if (process_ < 0) return true;
  shutdown(socket_.get(), SHUT_WR);
  const bool in_time = is_ready(socket_.get(), patience_to_end);
  if (!in_time) kill(process_, SIGKILL);
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {}
  process_ = -1;
  socket_.close();
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void Guardian::LinkHolder::hold(int fd, const std::vector<Address>& peers) {
  std::vector<sockaddr_storage> all(peers.size());
  for (std::size_t i = 0; i < peers.size(); ++i) std::memcpy(&all[i], peers[i].get(), peers[i].size());
  say(guardian_.socket_.get(), {Word::hold, link_}, std::as_bytes(std::span(all)), fd);
}

void Guardian::LinkHolder::let_go() { say(guardian_.socket_.get(), {Word::let_go, link_}); }

bool Guardian::LinkHolder::set_steers_itself(bool steers_itself) {
  return say(guardian_.socket_.get(), {steers_itself ? Word::self_steered : Word::steered, link_});
}

}  // namespace jarol::distributers
