#include "distributers/links/stream.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace jarol::distributers {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds first_pause{20};
constexpr milliseconds longest_pause{1000};
constexpr milliseconds send_limit{200};  // a peer that takes nothing for so long is lost

bool can_write(int fd) {
  pollfd polled{fd, POLLOUT, 0};
  return poll(&polled, 1, static_cast<int>(send_limit.count())) > 0;
}

}  // namespace

void StreamTransport::replace(Descriptor stream) {
  const std::lock_guard lock(stream_mutex_);
  if (stream_) ++counts.disconnected;
  stream_.close();
  stream_ = std::move(stream);
  if (stream_) ++counts.connected;
}

void StreamTransport::receive(const Interrupter& interrupter, ByteSink& sink) {
  milliseconds pause = first_pause;
  for (;;) {
    Descriptor stream = get_stream();
    if (stream) {
      pause = first_pause;
      replace(std::move(stream));
      sink.begin_stream();
      if (!receive_stream(interrupter, sink)) return;
      continue;
    }
    const bool announced = announces_peer() >= 0;
    if (interrupter.wait(announces_peer(), announced ? milliseconds(-1) : pause) == Interrupter::Woken::interrupted)
      return;
    pause = std::min(2 * pause, longest_pause);
  }
}

bool StreamTransport::receive_stream(const Interrupter& interrupter, ByteSink& sink) {
  std::array<std::byte, 65536> room;
  for (;;) {
    // a new peer takes the place of the old one: it may have been started anew without the old stream's ending
    if (announces_peer() >= 0 && interrupter.wait(announces_peer(), milliseconds(0)) == Interrupter::Woken::ready)
      return true;
    switch (interrupter.wait(stream_.get(), milliseconds(announces_peer() >= 0 ? 100 : -1))) {
      case Interrupter::Woken::interrupted: return false;
      case Interrupter::Woken::timed_out: continue;
      case Interrupter::Woken::ready: break;
    }
    const auto length = ::read(stream_.get(), room.data(), room.size());
    if (length < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (length <= 0) {
      replace({});
      return true;
    }
    sink.take(std::span(room).first(static_cast<std::size_t>(length)));
  }
}

bool StreamTransport::send(std::span<const std::byte> packet) {
  const std::lock_guard lock(stream_mutex_);
  const std::size_t whole = packet.size();
  while (stream_ && !packet.empty()) {
    const auto length = ::write(stream_.get(), packet.data(), packet.size());
    if (length > 0) {
      packet = packet.subspan(static_cast<std::size_t>(length));
    } else if (length >= 0 || (errno != EINTR && (errno != EAGAIN || !can_write(stream_.get())))) {
      break;
    }
  }
  if (stream_ && packet.empty()) return true;
  // after a part of a packet the peer would understand nothing: it sees the stream end
  if (stream_ && packet.size() < whole) ::shutdown(stream_.get(), SHUT_RDWR);
  ++counts.unsent;
  return false;
}

void StreamTransport::close() { replace({}); }

}  // namespace jarol::distributers
