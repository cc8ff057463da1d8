#include "distributers/links/frames.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace jarol::distributers {
namespace {

constexpr std::size_t longest = std::size_t{1} << 20;

bool wait_for(int fd, short events, std::chrono::milliseconds limit = FrameStream::patience) {
  pollfd polled{fd, events, 0};
  int ready = 0;
  while ((ready = poll(&polled, 1, static_cast<int>(limit.count()))) < 0 && errno == EINTR) {}
  return ready > 0;
}

// 0, or what went wrong.
int finish_connecting(int fd, std::chrono::milliseconds limit) {
  if (!wait_for(fd, POLLOUT, limit)) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

// A peer that goes with bytes unread resets the connection: an end as well.
[[noreturn]] void throw_ended(int error) {
  if (error == 0 || error == ECONNRESET || error == EPIPE) throw FrameEnd("the other end has ended the connection");
  throw FrameError(std::string("the connection has failed: ") + std::strerror(error));
}

}  // namespace

FrameStream FrameStream::connect(const Address& peer, std::chrono::milliseconds limit) {
  Descriptor made(socket(peer.family(), SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  int error = made && ::connect(made.get(), peer.get(), peer.size()) == 0 ? 0 : errno;
  if (error == EINPROGRESS) error = finish_connecting(made.get(), limit);
  if (error != 0)
    throw FrameError("there is no vehicle at " + peer.text() + ": " + std::strerror(error) +
                     "; start one by 'jarol vehicle NAME --link lockstep --listen " + std::to_string(peer.port()) +
                     "'");
  const int on = 1;
  setsockopt(made.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return FrameStream(std::move(made));
}

void FrameStream::put(FrameKind kind, std::span<const std::byte> bytes) {
  const auto size = static_cast<std::uint32_t>(bytes.size());
  for (int shift = 0; shift < 32; shift += 8) out_.push_back(static_cast<std::byte>(size >> shift));
  out_.push_back(static_cast<std::byte>(kind));
  out_.insert(out_.end(), bytes.begin(), bytes.end());
}

void FrameStream::flush() {
  std::span<const std::byte> rest = out_;
  while (!rest.empty()) {
    const auto length = ::send(socket_.get(), rest.data(), rest.size(), MSG_NOSIGNAL);
    if (length > 0) {
      rest = rest.subspan(static_cast<std::size_t>(length));
    } else if (errno != EINTR && (errno != EAGAIN || !wait_for(socket_.get(), POLLOUT))) {
      throw_ended(errno);
    }
  }
  out_.clear();
}

void FrameStream::read_bytes(std::span<std::byte> to) {
  while (!to.empty()) {
    if (!wait_for(socket_.get(), POLLIN)) throw FrameError("the other end has been silent for 10 s");
    const auto length = ::read(socket_.get(), to.data(), to.size());
    if (length == 0) throw_ended(0);
    if (length < 0 && errno != EINTR && errno != EAGAIN) throw_ended(errno);
    if (length > 0) to = to.subspan(static_cast<std::size_t>(length));
  }
}

bool FrameStream::wait(const Interrupter& interrupter) const {
  return interrupter.wait(socket_.get(), std::chrono::milliseconds(-1)) != Interrupter::Woken::interrupted;
}

FrameStream::Frame FrameStream::read() {
  std::array<std::byte, 5> head{};
  read_bytes(head);
  std::uint32_t size = 0;
  for (std::size_t i = 0; i < 4; ++i) size |= std::to_integer<std::uint32_t>(head[i]) << (8 * i);
  const auto kind = static_cast<FrameKind>(head[4]);
  if (kind < FrameKind::welcome || kind > FrameKind::no_state || size > longest)
    throw FrameError("the other end does not speak the lockstep protocol");
  in_.resize(size);
  read_bytes(in_);
  return {kind, in_};
}

}  // namespace jarol::distributers
