// Frames over a TCP connection that both ends trust: a length, a kind and bytes. What the lockstep link is made of.
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "distributers/links/address.h"
#include "distributers/links/descriptor.h"
#include "distributers/links/seal.h"
#include "graph/text/errors.h"

namespace jarol::distributers {

/// The other end has gone, is silent, or does not keep to the protocol.
class FrameError : public Unfinished {
 public:
  using Unfinished::Unfinished;
};

/// The other end has ended the connection.
class FrameEnd : public FrameError {
 public:
  using FrameError::FrameError;
};

/// What a frame is; the number is written.
enum class FrameKind : std::uint8_t {
  welcome = 1,  // vehicle to runner: version, grid, name of the message set
  begin,        // runner to vehicle: seed
  message,      // either way: a packet
  step,         // runner to vehicle: one grid step
  sense,        // runner to vehicle: what do the sensors report?
  sensed,       // vehicle to runner: that was all, after so many steps; what has become of it: instant, a text, or none
  no_state,     // vehicle to runner: it can't be stepped any more; a text
  busy,         // vehicle to runner: it has another; a text
};

/// Waits for the other end as long as `patience` says, for the whole of what it waits for, and throws FrameError then;
/// sooner where the process has been asked to end (asked_to_end.h).
class FrameStream {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds usual_patience{10'000};

  /// `who`: what errors call the other end.
  explicit FrameStream(Descriptor socket, std::string who = "the other end",
                       std::chrono::milliseconds patience = usual_patience)
      : socket_(std::move(socket)), who_(std::move(who)), patience_(patience) {}

  /// Connects, within that time. Throws FrameError that names the address.
  static FrameStream connect(const Address& peer, std::chrono::milliseconds limit = usual_patience);

  /// All that follows is sealed, both ways, once the other end has proved that it has the key.
  void secure(const SecretKey& key, std::string_view context) {
    offer_seal(key, context);
    await_seal();
  }
  /// The two halves of that: what is sent, and the wait for the answer.
  void offer_seal(const SecretKey& key, std::string_view context);
  void await_seal();

  const std::string& who() const { return who_; }
  int descriptor() const { return socket_.get(); }
  void set_patience(std::chrono::milliseconds patience) { patience_ = patience; }
  /// When the patience with what is waited for from now on is over.
  Clock::time_point begin_wait() {
    heard_ = false;
    waits_since_ = Clock::now();
    return waits_since_ + patience_;
  }

  /// Adds a frame to those that `flush` sends.
  void put(FrameKind kind, std::span<const std::byte> bytes = {});
  void flush();

  struct Frame {
    FrameKind kind{};
    std::span<const std::byte> bytes;  // until the next is read
  };
  /// The next frame, which has to be there as a whole by then.
  Frame read() { return read(begin_wait()); }
  Frame read(Clock::time_point deadline);
  /// Waits for the begin of a frame, or for somebody at another socket, where there is one.
  Interrupter::Either wait(const Interrupter& interrupter, int other, std::chrono::milliseconds time) const;

 private:
  void read_bytes(std::span<std::byte> to, Clock::time_point deadline);
  void read_raw(std::span<std::byte> to, Clock::time_point deadline);
  void write_raw(std::span<const std::byte> bytes);
  void read_sealed(Clock::time_point deadline);
  [[noreturn]] void fail(const std::string& what) const { throw FrameError(who_ + " " + what); }
  [[noreturn]] void fail_ended(int error) const;

  Descriptor socket_;
  std::string who_;
  std::chrono::milliseconds patience_;
  std::vector<std::byte> out_, in_;
  bool heard_ = false;  // within what is waited for
  Clock::time_point waits_since_{};

  std::unique_ptr<Seal> seal_;
  std::vector<std::byte> sealed_, plain_;
  std::size_t plain_at_ = 0;
};

}  // namespace jarol::distributers
