#include "distributers/links/stream.h"

#include <linux/sockios.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <thread>

namespace jarol::distributers {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;
constexpr milliseconds first_pause{20};
constexpr milliseconds longest_pause{1000};
constexpr milliseconds send_limit{200};  // how long a send waits for room; the next one does not wait if it was in vain
constexpr milliseconds delivery_limit{200};  // how long a close waits until the peer has what was sent
constexpr std::size_t max_waiting = 8;
constexpr std::size_t piece_size = 1 << 16;  // bytes that are read at once
constexpr std::size_t pieces_of_begin = 2;   // of a stream, to look at before it is taken or gives way

bool can_write(int fd, milliseconds time) {
  pollfd polled{fd, POLLOUT, 0};
  return poll(&polled, 1, static_cast<int>(time.count())) > 0;
}

bool has_gone(const Descriptor& stream) {
  std::byte first{};
  const auto length = ::recv(stream.get(), &first, 1, MSG_PEEK | MSG_DONTWAIT);
  return length == 0 || (length < 0 && errno != EAGAIN && errno != EINTR);
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

void StreamTransport::turn_away(const Address& peer) {
  ++counts.strangers;
  ownership_.count_stranger(peer);
}

void StreamTransport::receive(const Interrupter& interrupter, ByteSink& sink) {
  const auto interrupted = [&](int fd, milliseconds time) {
    return interrupter.wait(fd, time) == Interrupter::Woken::interrupted;
  };
  ownership_.begin(Clock::now());
  for (milliseconds pause{0};; pause = std::clamp(2 * pause, first_pause, longest_pause)) {
    if (interrupted(-1, pause)) return;
    if (waiting_.empty() && announces_peer() >= 0 && interrupted(announces_peer(), milliseconds(-1))) return;
    Waiting next;
    if (waiting_.empty()) {
      next = {get_stream(), {}};
      if (announces_peer() >= 0) next.peer = peer_of(next.stream);
    } else {
      next = std::move(waiting_.front());
      waiting_.erase(waiting_.begin());
    }
    if (!next.stream) continue;
    replace(std::move(next.stream));
    sink.begin_stream();
    const End end = receive_stream(interrupter, sink, next.peer);
    if (end == End::interrupted) return;
    if (end == End::good) pause = milliseconds(0);
  }
}

StreamTransport::End StreamTransport::receive_stream(const Interrupter& interrupter, ByteSink& sink,
                                                     const Address& peer) {
  const auto begin = Clock::now();
  const bool has_rivals = announces_peer() >= 0;
  bool valid = false;
  for (;;) {
    ownership_.look(Clock::now());
    const bool displaced = has_rivals && is_displaced(sink, valid);
    if (!displaced) {
      switch (interrupter.wait(stream_.get(), has_rivals ? Ownership::look_interval : milliseconds(-1))) {
        case Interrupter::Woken::interrupted: return End::interrupted;
        case Interrupter::Woken::timed_out: continue;
        case Interrupter::Woken::ready: break;
      }
    }
    // also of one that is to give way: what it has sent until now came before the other was looked at
    Piece piece = take_piece(sink);
    for (std::size_t i = 1; displaced && piece == Piece::other && i < pieces_of_begin; ++i) piece = take_piece(sink);
    if (piece == Piece::end) {
      if (valid) ownership_.gone();
      replace({});
      return valid || Clock::now() - begin > longest_pause ? End::good : End::bad;
    }
    if (piece == Piece::valid) {
      valid = true;
      if (has_rivals) ownership_.heard(peer, Clock::now());
    } else if (displaced) {
      if (!valid) turn_away(peer);
      return End::good;  // the other need not wait
    }
  }
}

StreamTransport::Piece StreamTransport::take_piece(ByteSink& sink) {
  std::array<std::byte, piece_size> room;
  const auto length = ::read(stream_.get(), room.data(), room.size());
  if (length < 0 && (errno == EAGAIN || errno == EINTR)) return Piece::none;
  if (length <= 0) return Piece::end;
  const bool has_valid = sink.take(std::span(room).first(static_cast<std::size_t>(length)));
  if (const auto answer = sink.answer(); !answer.empty()) send(answer);
  if (sink.is_broken()) return Piece::end;
  return has_valid ? Piece::valid : Piece::other;
}

bool StreamTransport::speaks_validly(const Waiting& waiting, const ByteSink& sink) {
  std::vector<std::byte> room(pieces_of_begin * piece_size);
  const auto length = ::recv(waiting.stream.get(), room.data(), room.size(), MSG_PEEK | MSG_DONTWAIT);
  return length > 0 && sink.is_valid_begin(std::span(room).first(static_cast<std::size_t>(length)));
}

// The oldest make room for those who come, unless they have spoken validly; no more at a time than a flood of them may
// take.
void StreamTransport::collect_waiting(const ByteSink& sink) {
  for (int i = 0; i < 64; ++i) {
    const bool full = waiting_.size() == max_waiting;
    if (full && speaks_validly(waiting_.front(), sink)) break;
    Descriptor stream = get_stream();
    if (!stream) break;
    if (full) {
      turn_away(waiting_.front().peer);
      waiting_.erase(waiting_.begin());
    }
    const Address peer = peer_of(stream);
    waiting_.push_back({std::move(stream), peer});
  }
  std::erase_if(waiting_, [](const Waiting& waiting) { return has_gone(waiting.stream); });
}

// One that has spoken validly keeps its place until it is silent; others are turned away. Until then, and after that,
// the place is that of the first other who speaks validly: it may have been started anew without the end of its stream.
bool StreamTransport::is_displaced(const ByteSink& sink, bool valid) {
  collect_waiting(sink);
  if (waiting_.empty()) return false;
  if (valid && !ownership_.is_silent()) {
    for (const Waiting& waiting : waiting_) turn_away(waiting.peer);
    waiting_.clear();
    return false;
  }
  auto next = std::find_if(waiting_.begin(), waiting_.end(),
                           [&](const Waiting& waiting) { return speaks_validly(waiting, sink); });
  if (next == waiting_.end() && valid && stuck_) next = waiting_.begin();
  if (next == waiting_.end()) return false;
  std::rotate(waiting_.begin(), next, next + 1);
  return true;
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

// A stream that is closed while its peer still speaks is broken off, and what has not arrived by then never does: first
// it ends in the one direction only, and what comes is thrown away. Other streams than sockets need no such care.
void StreamTransport::await_delivery() {
  const std::lock_guard lock(stream_mutex_);
  if (!stream_ || ::shutdown(stream_.get(), SHUT_WR) != 0) return;
  std::array<std::byte, 4096> room;
  for (const auto end = Clock::now() + delivery_limit; Clock::now() < end;) {
    const auto length = ::recv(stream_.get(), room.data(), room.size(), MSG_DONTWAIT);
    if (length < 0 && errno != EAGAIN && errno != EINTR) return;
    int under_way = 0;
    if (::ioctl(stream_.get(), SIOCOUTQ, &under_way) != 0 || under_way == 0) return;
    if (length <= 0) std::this_thread::sleep_for(milliseconds(1));
  }
}

void StreamTransport::close() {
  await_delivery();
  replace({});
  waiting_.clear();
}

}  // namespace jarol::distributers
