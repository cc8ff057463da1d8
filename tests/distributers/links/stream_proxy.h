// Stands between two ends of a stream, a serial line or a TCP connection, and disturbs what goes through it, by a seed.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <span>

#include "tests/distributers/links/lossy_proxy.h"

namespace jarol::tests {

/// What happens to the bytes of one direction. They are cut into pieces, none of which overtakes another; where, and
/// which are lost, doubled and damaged, depends on the seed and the number of bytes before them alone.
class DisturbedStream {
 public:
  using Clock = Disturbed::Clock;

  DisturbedStream(const Disturbance& disturbance, std::uint64_t seed) : disturbance_(disturbance), random_(seed) {}

  void take(std::span<const std::byte> bytes, Clock::time_point now);
  void lose(std::size_t bytes);
  /// The next bytes that are due, if there are any.
  bool give(Clock::time_point now, std::vector<std::byte>& bytes);
  Clock::time_point next_due() const { return waiting_.empty() ? Clock::time_point::max() : waiting_.front().due; }

  ProxyCounts counts;
  std::vector<std::uint64_t> hit;  // which bytes were lost or damaged; the first is 0

 private:
  double chance() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  void begin_piece();
  void queue(std::span<const std::byte> bytes, Clock::time_point due);

  Disturbance disturbance_;
  std::mt19937_64 random_;
  struct Piece {
    std::size_t left = 0;  // bytes that have not come
    bool lost = false, doubled = false;
    std::size_t damaged = 0;  // its byte with so many left behind it and itself; 0: none
    std::byte flip{};
    Clock::duration delay{};
    std::vector<std::byte> bytes;  // as they go out
  } piece_;
  struct Waiting {
    Clock::time_point due;
    std::vector<std::byte> bytes;
  };
  std::deque<Waiting> waiting_;
  Clock::time_point last_due_{};
};

/// Bytes between two ends. What an end does not take within a second is lost, and so is what follows until it does.
class StreamProxy {
 public:
  virtual ~StreamProxy() = default;
  /// From now on all that comes is lost, while it is closed.
  void close(bool closed);
  /// Bytes that came from that end.
  ProxyCounts from(std::size_t end) const;
  /// Which of them were lost or damaged.
  std::vector<std::uint64_t> hit(std::size_t end) const;

 protected:
  StreamProxy(const Disturbance& disturbance, std::uint64_t seed)
      : ways_{DisturbedStream(disturbance, seed), DisturbedStream(disturbance, seed + 1)} {}
  void start();
  /// Before the ends go.
  void stop();

  std::array<distributers::Descriptor, 2> ends_;

 private:
  /// Called again and again; false: there is nothing to carry yet.
  virtual bool find_ends() { return true; }
  /// An end can't be read from any more.
  virtual void ended() {}

  void run();
  bool read(std::size_t from);
  void write(std::size_t from);

  distributers::Interrupter interrupter_;
  mutable std::mutex mutex_;
  std::array<DisturbedStream, 2> ways_;
  std::array<bool, 2> stuck_{};
  bool closed_ = false;
  std::thread thread_;
};

/// Between two pseudo terminals, whose names the ends of a serial link open.
class SerialProxy : public StreamProxy {
 public:
  SerialProxy(const Disturbance& disturbance, std::uint64_t seed);
  ~SerialProxy() override { stop(); }

  const std::string& name(std::size_t end) const { return names_[end]; }

 private:
  std::array<std::string, 2> names_;
};

/// Between whoever connects, end 0, and a server, end 1. When one of them goes both connections end.
class TcpProxy : public StreamProxy {
 public:
  TcpProxy(const distributers::Address& server, const Disturbance& disturbance, std::uint64_t seed);
  ~TcpProxy() override { stop(); }

  int port() const { return distributers::port_of(socket_); }

 private:
  bool find_ends() override;
  void ended() override;

  distributers::Address server_;
  distributers::Descriptor socket_;
};

}  // namespace jarol::tests
