#include "distributers/links/frames.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "graph/language/quantities.h"
#include "runtime/machine/asked_to_end.h"

namespace jarol::distributers {
namespace {

constexpr std::size_t longest_frame = std::size_t{1} << 20;

using Clock = FrameStream::Clock;

enum class Waited { ready, too_long, asked_to_end };

Waited wait_for(int fd, short events, Clock::time_point since, Clock::time_point deadline) {
  pollfd polled{fd, events, 0};
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    if (left.count() <= 0) return Waited::too_long;
    const int ready = poll(&polled, 1, static_cast<int>(std::min(left, look_at_end).count()));
    if (ready > 0) return Waited::ready;
    if (ready < 0 && errno != EINTR) return Waited::too_long;
    if (has_waited_enough(since)) return Waited::asked_to_end;
  }
}

// 0, or what went wrong.
int connect_within(int fd, std::chrono::milliseconds limit) {
  const auto since = Clock::now();
  if (wait_for(fd, POLLOUT, since, since + limit) != Waited::ready) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

}  // namespace

FrameStream FrameStream::connect(const Address& peer, std::chrono::milliseconds limit) {
  Descriptor made(socket(peer.family(), SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  int error = made && ::connect(made.get(), peer.get(), peer.size()) == 0 ? 0 : errno;
  if (error == EINPROGRESS) error = connect_within(made.get(), limit);
  if (error == 0 && is_connected_to_itself(made)) {
    break_off(std::move(made));
    error = ECONNREFUSED;
  }
  if (error != 0)
    throw FrameError("there is no vehicle at " + peer.text() + ": " + std::strerror(error) +
                     "; start one by 'jarol vehicle NAME --link lockstep --listen " + std::to_string(peer.port()) +
                     "'");
  const int on = 1;
  setsockopt(made.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return FrameStream(std::move(made), "the vehicle at " + peer.text(), limit);
}

void FrameStream::put(FrameKind kind, std::span<const std::byte> bytes) {
  const auto size = static_cast<std::uint32_t>(bytes.size());
  for (int shift = 0; shift < 32; shift += 8) out_.push_back(static_cast<std::byte>(size >> shift));
  out_.push_back(static_cast<std::byte>(kind));
  out_.insert(out_.end(), bytes.begin(), bytes.end());
}

void FrameStream::flush() {
  if (out_.empty()) return;
  if (seal_) seal_->seal(out_, sealed_);
  write_raw(seal_ ? sealed_ : out_);
  out_.clear();
}

void FrameStream::write_raw(std::span<const std::byte> bytes) {
  const auto since = Clock::now();
  while (!bytes.empty()) {
    const auto length = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (length > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(length));
      continue;
    }
    if (errno != EINTR && errno != EAGAIN) fail_ended(errno);
    switch (wait_for(socket_.get(), POLLOUT, since, since + patience_)) {
      case Waited::ready: break;
      case Waited::too_long: fail("has taken nothing for " + duration_text(patience_));
      case Waited::asked_to_end: fail("took nothing when the run was to end");
    }
  }
}

// A peer that goes with bytes unread resets the connection: an end as well.
void FrameStream::fail_ended(int error) const {
  if (error == 0 || error == ECONNRESET || error == EPIPE) throw FrameEnd(who_ + " has ended the connection");
  throw FrameError("the connection with " + who_ + " has failed: " + std::strerror(error));
}

void FrameStream::read_raw(std::span<std::byte> to, Clock::time_point deadline) {
  while (!to.empty()) {
    switch (wait_for(socket_.get(), POLLIN, waits_since_, deadline)) {
      case Waited::ready: break;
      case Waited::too_long:
        fail(heard_ ? "has not come to an end within " + duration_text(patience_)
                    : "has been silent for " + duration_text(patience_));
      case Waited::asked_to_end: fail("was silent when the run was to end");
    }
    const auto length = ::read(socket_.get(), to.data(), to.size());
    if (length == 0) fail_ended(0);
    if (length < 0 && errno != EINTR && errno != EAGAIN) fail_ended(errno);
    if (length <= 0) continue;
    heard_ = true;
    to = to.subspan(static_cast<std::size_t>(length));
  }
}

void FrameStream::offer_seal(const SecretKey& key, std::string_view context) {
  seal_ = std::make_unique<Seal>(key, "lockstep " + std::string(context));
  write_raw(seal_->hello());
}

void FrameStream::await_seal() {
  for (const auto until = begin_wait(); !seal_->knows_peer();) read_sealed(until);
}

// One packet; what was in it follows what is plain.
void FrameStream::read_sealed(Clock::time_point deadline) {
  sealed_.resize(Seal::head_size);
  read_raw(sealed_, deadline);
  const bool is_busy = static_cast<FrameKind>(sealed_[4]) == FrameKind::busy;
  if (!Seal::is_sealed(sealed_) && is_busy) fail("is busy: it is with another");
  if (!Seal::is_sealed(sealed_)) fail("has no key; both ends need the same, or none");
  const std::size_t size = Seal::size_of(sealed_);
  if (size > Seal::overhead + 2 * longest_frame) fail("does not speak the lockstep protocol");
  sealed_.resize(size);
  read_raw(std::span(sealed_).subspan(Seal::head_size), deadline);
  const Seal::Opened opened = seal_->open(sealed_);
  if (opened.finding == Seal::Finding::wrong_key) fail("has another key");
  if (opened.finding == Seal::Finding::content)
    plain_.insert(plain_.end(), opened.content.begin(), opened.content.end());
  else if (opened.finding != Seal::Finding::hello)
    fail("has sent what can't be taken: " + std::string(name_of(opened.finding)));
  if (!seal_->answer().empty()) write_raw(seal_->answer());
}

void FrameStream::read_bytes(std::span<std::byte> to, Clock::time_point deadline) {
  if (!seal_) return read_raw(to, deadline);
  while (plain_.size() - plain_at_ < to.size()) read_sealed(deadline);
  std::copy_n(plain_.begin() + static_cast<std::ptrdiff_t>(plain_at_), to.size(), to.begin());
  plain_at_ += to.size();
  if (plain_at_ < plain_.size()) return;
  plain_.clear();
  plain_at_ = 0;
}

Interrupter::Either FrameStream::wait(const Interrupter& interrupter, int other, std::chrono::milliseconds time) const {
  if (plain_at_ < plain_.size()) return {.interrupted = false, .one = true, .other = false};
  return interrupter.wait_for_either(socket_.get(), other, time);
}

FrameStream::Frame FrameStream::read(Clock::time_point deadline) {
  if (Clock::now() >= deadline) fail("has not come to an end within " + duration_text(patience_));
  std::array<std::byte, 5> head{};
  read_bytes(head, deadline);
  std::uint32_t size = 0;
  for (std::size_t i = 0; i < 4; ++i) size |= std::to_integer<std::uint32_t>(head[i]) << (8 * i);
  const auto kind = static_cast<FrameKind>(head[4]);
  if (!seal_ && Seal::is_sealed(head)) fail("asks for a key; both ends need the same, or none");
  if (kind < FrameKind::welcome || kind > FrameKind::busy || size > longest_frame)
    fail("does not speak the lockstep protocol");
  in_.resize(size);
  read_bytes(in_, deadline);
  return {kind, in_};
}

}  // namespace jarol::distributers
