#include "distributers/links/stream.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <utility>

namespace jarol::distributers {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;
constexpr milliseconds first_pause{20};
constexpr milliseconds longest_pause{1000};
constexpr milliseconds look{100};        // for a newer peer, while there is one
constexpr milliseconds send_limit{200};  // how long a send waits for room; the next one does not wait if it was in vain

bool can_write(int fd, milliseconds time) {
  pollfd polled{fd, POLLOUT, 0};
  return poll(&polled, 1, static_cast<int>(time.count())) > 0;
}

}  // namespace

void StreamTransport::replace(Descriptor stream) {
  const std::lock_guard lock(stream_mutex_);
  if (stream_) {
    ++counts.disconnected;
    // the peer sees the end now, whoever else holds the stream
    ::shutdown(stream_.get(), SHUT_RDWR);
    if (holder != nullptr) holder->let_go();
  }
  stream_.close();
  stream_ = std::move(stream);
  stuck_ = false;
  if (!stream_) return;
  ++counts.connected;
  if (holder != nullptr) holder->hold(stream_.get(), {});
}

void StreamTransport::receive(const Interrupter& interrupter, ByteSink& sink) {
  const auto interrupted = [&](int fd, milliseconds time) {
    return interrupter.wait(fd, time) == Interrupter::Woken::interrupted;
  };
  for (milliseconds pause{0};; pause = std::clamp(2 * pause, first_pause, longest_pause)) {
    if (interrupted(-1, pause)) return;
    if (!newer_ && announces_peer() >= 0 && interrupted(announces_peer(), milliseconds(-1))) return;
    Descriptor stream = newer_ ? std::move(newer_) : get_stream();
    if (!stream) continue;
    replace(std::move(stream));
    sink.begin_stream();
    const End end = receive_stream(interrupter, sink);
    if (end == End::interrupted) return;
    if (end == End::good) pause = milliseconds(0);
  }
}

StreamTransport::End StreamTransport::receive_stream(const Interrupter& interrupter, ByteSink& sink) {
  std::array<std::byte, 65536> room;
  const auto begin = Clock::now();
  auto looked = begin;
  Clock::duration silence{};
  bool valid = false;
  const auto end = [&] { return valid || Clock::now() - begin > longest_pause ? End::good : End::bad; };
  for (;;) {
    // what takes longer than a look is this machine's, which has halted: no silence of the peer
    const auto now = Clock::now();
    silence += std::min<Clock::duration>(now - std::exchange(looked, now), look);
    if (announces_peer() >= 0 && is_displaced(silence > longest_pause)) return end();
    switch (interrupter.wait(stream_.get(), milliseconds(announces_peer() >= 0 ? look.count() : -1))) {
      case Interrupter::Woken::interrupted: return End::interrupted;
      case Interrupter::Woken::timed_out: continue;
      case Interrupter::Woken::ready: break;
    }
    const auto length = ::read(stream_.get(), room.data(), room.size());
    if (length < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (length <= 0) {
      replace({});
      return end();
    }
    if (!sink.take(std::span(room).first(static_cast<std::size_t>(length)))) continue;
    valid = true;
    silence = {};
  }
}

// A peer may have been started anew without the end of its old stream. But one that is there and speaks keeps its
// place.
bool StreamTransport::is_displaced(bool silent) {
  if (!newer_) newer_ = get_stream();
  if (!newer_) return false;
  std::byte first{};
  const auto length = ::recv(newer_.get(), &first, 1, MSG_PEEK | MSG_DONTWAIT);
  const bool gone = length == 0 || (length < 0 && errno != EAGAIN && errno != EINTR);
  if (!silent || gone) newer_.close();
  return newer_ && (length > 0 || stuck_);
}

bool StreamTransport::send(std::span<const std::byte> packet) {
  const std::lock_guard lock(stream_mutex_);
  const std::size_t whole = packet.size();
  while (stream_ && !packet.empty()) {
    const auto length = ::write(stream_.get(), packet.data(), packet.size());
    if (length > 0) {
      packet = packet.subspan(static_cast<std::size_t>(length));
    } else if (length >= 0 || (errno != EINTR && errno != EAGAIN)) {
      break;
    } else if (errno == EAGAIN && !can_write(stream_.get(), stuck_ ? milliseconds(0) : send_limit)) {
      stuck_ = true;
      break;
    }
  }
  if (stream_ && packet.empty()) {
    stuck_ = false;
    return true;
  }
  // after a part of a packet the peer would understand nothing: it sees the stream end
  if (stream_ && packet.size() < whole) ::shutdown(stream_.get(), SHUT_RDWR);
  ++counts.unsent;
  return false;
}

void StreamTransport::close() {
  replace({});
  newer_.close();
}

}  // namespace jarol::distributers
