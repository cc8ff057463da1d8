#include "tests/distributers/links/stream_proxy.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>

#include "distributers/links/tcp.h"

namespace jarol::tests {
namespace {

using namespace jarol::distributers;
using namespace std::chrono_literals;

constexpr int patience = 1000;  // ms

}  // namespace

void DisturbedStream::begin_piece() {
  // as many draws for each, whatever becomes of it
  const double length = chance(), loss = chance(), duplication = chance(), damage = chance(), where = chance(),
               flip = chance(), delay = chance();
  piece_ = {};
  piece_.left = 1 + static_cast<std::size_t>(length * static_cast<double>(disturbance_.longest_piece));
  piece_.lost = loss < disturbance_.loss;
  piece_.doubled = !piece_.lost && duplication < disturbance_.duplication;
  if (!piece_.lost && damage < disturbance_.damage)
    piece_.damaged = 1 + static_cast<std::size_t>(where * static_cast<double>(piece_.left));
  piece_.flip = static_cast<std::byte>(1 + static_cast<int>(flip * 255));
  const std::chrono::duration<double, std::milli> wait = delay * disturbance_.delay;
  piece_.delay = std::chrono::duration_cast<Clock::duration>(wait);
}

void DisturbedStream::queue(std::span<const std::byte> bytes, Clock::time_point due) {
  last_due_ = due;
  waiting_.push_back({due, {bytes.begin(), bytes.end()}});
}

void DisturbedStream::take(std::span<const std::byte> bytes, Clock::time_point now) {
  while (!bytes.empty()) {
    if (piece_.left == 0) begin_piece();
    // of a piece that has not come as a whole what is there goes on
    const std::size_t begun = piece_.bytes.size();
    for (; piece_.left > 0 && !bytes.empty(); --piece_.left, bytes = bytes.subspan(1)) {
      const bool damaged = piece_.left == piece_.damaged;
      if (damaged || piece_.lost) hit.push_back(counts.in);
      if (damaged) ++counts.damaged;
      ++counts.in;
      piece_.bytes.push_back(damaged ? bytes.front() ^ piece_.flip : bytes.front());
    }
    const std::size_t came = piece_.bytes.size() - begun;
    if (piece_.lost) {
      counts.lost += came;
      continue;
    }
    queue(std::span(piece_.bytes).subspan(begun), std::max(now, last_due_) + (begun == 0 ? piece_.delay : 0ns));
    if (piece_.left > 0 || !piece_.doubled) continue;
    counts.duplicated += piece_.bytes.size();
    queue(piece_.bytes, last_due_);
  }
}

void DisturbedStream::lose(std::size_t bytes) {
  counts.in += bytes;
  counts.lost += bytes;
}

bool DisturbedStream::give(Clock::time_point now, std::vector<std::byte>& bytes) {
  if (waiting_.empty() || waiting_.front().due > now) return false;
  bytes = std::move(waiting_.front().bytes);
  waiting_.pop_front();
  return true;
}

void StreamProxy::close(bool closed) {
  const std::lock_guard lock(mutex_);
  closed_ = closed;
}

ProxyCounts StreamProxy::from(std::size_t end) const {
  const std::lock_guard lock(mutex_);
  return ways_[end].counts;
}

std::vector<std::uint64_t> StreamProxy::hit(std::size_t end) const {
  const std::lock_guard lock(mutex_);
  return ways_[end].hit;
}

void StreamProxy::start() {
  thread_ = std::thread([this] { run(); });
}

void StreamProxy::stop() {
  interrupter_.interrupt();
  thread_.join();
}

void StreamProxy::run() {
  while (interrupter_.wait(-1, 0ms) != Interrupter::Woken::interrupted) {
    if (!find_ends()) continue;
    const auto due = std::min(ways_[0].next_due(), ways_[1].next_due());
    const auto wait = std::clamp<std::chrono::nanoseconds>(
        due == DisturbedStream::Clock::time_point::max() ? 5ms : due - DisturbedStream::Clock::now(), 0ns, 5ms);
    pollfd polled[] = {{ends_[0].get(), POLLIN, 0}, {ends_[1].get(), POLLIN, 0}};
    const timespec limit{0, wait.count()};
    ppoll(polled, 2, &limit, nullptr);
    const bool one = read(0), other = read(1);
    write(0);
    write(1);
    // an end that nobody has open is never ready
    if (!one && !other && ((polled[0].revents | polled[1].revents) & POLLHUP) != 0) std::this_thread::sleep_for(1ms);
  }
}

bool StreamProxy::read(std::size_t from) {
  std::array<std::byte, 4096> room{};
  if (!ends_[from]) return false;
  const auto length = ::read(ends_[from].get(), room.data(), room.size());
  if (length == 0 || (length < 0 && errno != EAGAIN && errno != EINTR)) ended();
  if (length <= 0) return false;
  const std::lock_guard lock(mutex_);
  const auto bytes = std::span<const std::byte>(room).first(static_cast<std::size_t>(length));
  if (closed_)
    ways_[from].lose(bytes.size());
  else
    ways_[from].take(bytes, DisturbedStream::Clock::now());
  return true;
}

void StreamProxy::write(std::size_t from) {
  const std::lock_guard lock(mutex_);
  DisturbedStream& way = ways_[from];
  const int to = ends_[1 - from].get();
  // what an end that has gone did not get the next one does not get either
  const auto due = [&] { return to >= 0 ? DisturbedStream::Clock::now() : DisturbedStream::Clock::time_point::max(); };
  for (std::vector<std::byte> bytes; way.give(due(), bytes);) {
    std::span<const std::byte> rest = bytes;
    while (!rest.empty()) {
      const auto written = ::write(to, rest.data(), rest.size());
      if (written > 0) {
        rest = rest.subspan(static_cast<std::size_t>(written));
        way.counts.out += static_cast<std::uint64_t>(written);
        stuck_[from] = false;
        continue;
      }
      pollfd polled{to, POLLOUT, 0};
      if (errno == EAGAIN && !stuck_[from] && poll(&polled, 1, patience) == 1) continue;
      stuck_[from] = true;
      way.counts.lost += rest.size();
      break;
    }
  }
}

SerialProxy::SerialProxy(const Disturbance& disturbance, std::uint64_t seed) : StreamProxy(disturbance, seed) {
  for (std::size_t i = 0; i < 2; ++i) {
    ends_[i] = Descriptor(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (grantpt(ends_[i].get()) != 0 || unlockpt(ends_[i].get()) != 0) throw std::runtime_error("no pseudo terminal");
    names_[i] = ptsname(ends_[i].get());
  }
  start();
}

TcpProxy::TcpProxy(const Address& server, const Disturbance& disturbance, std::uint64_t seed)
    : StreamProxy(disturbance, seed), server_(server), socket_(listen_at(Address::parse("127.0.0.1:0"))) {
  start();
}

bool TcpProxy::find_ends() {
  if (ends_[0]) return true;
  pollfd polled{socket_.get(), POLLIN, 0};
  poll(&polled, 1, 5);
  Descriptor client = accept_from(socket_);
  if (!client) return false;
  Descriptor server(socket(server_.family(), SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (connect(server.get(), server_.get(), server_.size()) != 0) return false;
  fcntl(server.get(), F_SETFL, O_NONBLOCK);
  const int on = 1;
  setsockopt(server.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  ends_ = {std::move(client), std::move(server)};
  return true;
}

void TcpProxy::ended() {
  for (Descriptor& end : ends_) end.close();
}

}  // namespace jarol::tests
