// Frames over a TCP connection that both ends trust: a length, a kind and bytes. What the lockstep link is made of.
#pragma once

#include <chrono>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "distributers/links/address.h"
#include "distributers/links/descriptor.h"

namespace jarol::distributers {

/// The other end has gone, is silent, or does not keep to the protocol.
class FrameError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
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
  sense,        // runner to vehicle: what do the sensors tell?
  sensed,       // vehicle to runner: that was all
  no_state,     // vehicle to runner: it can't be stepped any more; a text
};

/// Waits for the other end as long as `patience` says, and throws FrameError then.
class FrameStream {
 public:
  static constexpr std::chrono::milliseconds patience{10'000};

  explicit FrameStream(Descriptor socket) : socket_(std::move(socket)) {}

  /// Connects, within that time. Throws FrameError that names the address.
  static FrameStream connect(const Address& peer, std::chrono::milliseconds limit = patience);

  /// Adds a frame to those that `flush` sends.
  void put(FrameKind kind, std::span<const std::byte> bytes = {});
  void flush();

  struct Frame {
    FrameKind kind{};
    std::span<const std::byte> bytes;  // until the next is read
  };
  /// The next frame. With a wait for the first byte that may be interrupted: none then.
  Frame read();
  bool wait(const Interrupter& interrupter) const;

 private:
  void read_bytes(std::span<std::byte> to);

  Descriptor socket_;
  std::vector<std::byte> out_, in_;
};

}  // namespace jarol::distributers
