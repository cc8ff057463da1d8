// Stands between two ends of a link and disturbs what goes through it, by a seed.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "distributers/links/address.h"
#include "distributers/links/descriptor.h"

namespace jarol::tests {

/// Probabilities for each piece that goes through: a datagram, or a few bytes of a stream.
struct Disturbance {
  double loss = 0;
  double duplication = 0;
  double reordering = 0;               // of datagrams: it waits for `held` longer than others
  double damage = 0;                   // of streams: one byte of the piece becomes another
  std::chrono::microseconds delay{0};  // at most: of each datagram; of a stream's piece after the one before it
  std::chrono::milliseconds held{30};
  std::size_t longest_piece = 16;  // of a stream, in bytes
};

/// What became of all that came from one end: in + duplicated = lost + out, and what is held back yet.
struct ProxyCounts {
  std::uint64_t in = 0, lost = 0, duplicated = 0, out = 0;
  std::uint64_t reordered = 0;  // went out after one that had come later
  std::uint64_t damaged = 0;
};

/// What happens to the pieces of one direction: which of them are lost and so on depends on the seed and their order
/// alone.
class Disturbed {
 public:
  using Clock = std::chrono::steady_clock;

  Disturbed(const Disturbance& disturbance, std::uint64_t seed) : disturbance_(disturbance), random_(seed) {}

  void take(std::vector<std::byte> piece, Clock::time_point now);
  void lose() { ++counts.in, ++counts.lost; }
  /// The next piece that is due, if there is one.
  bool give(Clock::time_point now, std::vector<std::byte>& piece);
  /// When the next is; far away if there is none.
  Clock::time_point next_due() const;

  ProxyCounts counts;

 private:
  double chance() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  Disturbance disturbance_;
  std::mt19937_64 random_;
  struct Piece {
    std::uint64_t number = 0;
    std::vector<std::byte> bytes;
  };
  std::multimap<Clock::time_point, Piece> waiting_;
  std::uint64_t taken_ = 0, newest_given_ = 0;
};

/// Datagrams between a named address and whoever else sends.
class UdpProxy {
 public:
  UdpProxy(const distributers::Address& target, const Disturbance& disturbance, std::uint64_t seed);
  ~UdpProxy();

  int port() const { return distributers::port_of(socket_); }
  /// From now on all that comes is lost, while it is closed.
  void close(bool closed);
  /// Of what went to the target, and of what came from it.
  ProxyCounts to_target() const;
  ProxyCounts from_target() const;

 private:
  void run();

  distributers::Descriptor socket_;
  distributers::Address target_;
  distributers::Interrupter interrupter_;
  mutable std::mutex mutex_;
  Disturbed to_target_, from_target_;
  bool closed_ = false;
  std::thread thread_;
};

}  // namespace jarol::tests
