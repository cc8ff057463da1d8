#include "tests/distributers/links/lossy_proxy.h"

#include <sys/socket.h>

#include <algorithm>
#include <stdexcept>

namespace jarol::tests {
namespace {

using namespace jarol::distributers;
using namespace std::chrono_literals;

}  // namespace

void Disturbed::take(std::vector<std::byte> piece, Clock::time_point now) {
  ++counts.in;
  ++taken_;
  // as many draws for each, whatever becomes of it
  const double loss = chance(), duplication = chance(), reordering = chance(), delay = chance(), later = chance();
  if (loss < disturbance_.loss) {
    ++counts.lost;
    return;
  }
  const auto due = [&](double part) {
    const std::chrono::duration<double, std::milli> wait = part * disturbance_.delay;
    return now + std::chrono::duration_cast<Clock::duration>(wait);
  };
  if (duplication < disturbance_.duplication) {
    ++counts.duplicated;
    waiting_.emplace(due(later), Piece{taken_, piece});
  }
  const auto held = reordering < disturbance_.reordering ? disturbance_.held : 0ms;
  waiting_.emplace(due(delay) + held, Piece{taken_, std::move(piece)});
}

bool Disturbed::give(Clock::time_point now, std::vector<std::byte>& piece) {
  if (waiting_.empty() || waiting_.begin()->first > now) return false;
  Piece& next = waiting_.begin()->second;
  if (next.number < newest_given_) ++counts.reordered;
  newest_given_ = std::max(newest_given_, next.number);
  piece = std::move(next.bytes);
  waiting_.erase(waiting_.begin());
  ++counts.out;
  return true;
}

Disturbed::Clock::time_point Disturbed::next_due() const {
  return waiting_.empty() ? Clock::time_point::max() : waiting_.begin()->first;
}

UdpProxy::UdpProxy(const Address& target, const Disturbance& disturbance, std::uint64_t seed)
    : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)),
      target_(target),
      to_target_(disturbance, seed),
      from_target_(disturbance, seed + 1) {
  const Address any = Address::parse("127.0.0.1:0");
  if (bind(socket_.get(), any.get(), any.size()) != 0) throw std::runtime_error("no port for a proxy");
  thread_ = std::thread([this] { run(); });
}

UdpProxy::~UdpProxy() {
  interrupter_.interrupt();
  thread_.join();
}

void UdpProxy::close(bool closed) {
  const std::lock_guard lock(mutex_);
  closed_ = closed;
}

ProxyCounts UdpProxy::to_target() const {
  const std::lock_guard lock(mutex_);
  return to_target_.counts;
}

ProxyCounts UdpProxy::from_target() const {
  const std::lock_guard lock(mutex_);
  return from_target_.counts;
}

void UdpProxy::run() {
  Address other;  // who sends to the target
  std::vector<std::byte> room(65536), piece;
  for (auto wait = 1ms;;) {
    if (interrupter_.wait(socket_.get(), wait) == Interrupter::Woken::interrupted) return;
    const std::lock_guard lock(mutex_);
    const auto now = Disturbed::Clock::now();
    for (;;) {
      sockaddr_storage from{};
      socklen_t size = sizeof from;
      const auto length =
          recvfrom(socket_.get(), room.data(), room.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
      if (length < 0) break;
      const Address sender = Address::of(from, size);
      const bool back = sender == target_;
      if (!back) other = sender;
      Disturbed& way = back ? from_target_ : to_target_;
      if (closed_ || (back && !other))
        way.lose();
      else
        way.take({room.begin(), room.begin() + length}, now);
    }
    while (to_target_.give(now, piece))
      sendto(socket_.get(), piece.data(), piece.size(), 0, target_.get(), target_.size());
    while (from_target_.give(now, piece))
      sendto(socket_.get(), piece.data(), piece.size(), 0, other.get(), other.size());
    const auto due = std::min(to_target_.next_due(), from_target_.next_due());
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(due - now);
    wait = std::clamp(left, std::chrono::milliseconds(1), std::chrono::milliseconds(20));
  }
}

}  // namespace jarol::tests
