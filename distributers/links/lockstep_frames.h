// What both ends of the lockstep link put into its frames: numbers, texts and messages.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "distributers/links/frames.h"
#include "distributers/messages/packet.h"

namespace jarol::distributers {

inline constexpr std::uint64_t lockstep_version = 2;

// Both ends are this program, which runs on little-endian machines only.
std::vector<std::byte> numbers(std::initializer_list<std::uint64_t> all, const std::string& text = "");
/// Throws FrameError where the frame is too short.
std::uint64_t number(const FrameStream::Frame& frame, std::size_t index);
/// What follows so many numbers.
std::string text_after(const FrameStream::Frame& frame, std::size_t count);

[[noreturn]] void throw_unfit(const FrameStream& stream);

/// Puts messages into frames.
class Putter : public messages::Receiver {
 public:
  Putter(const messages::MessageSet& set, FrameStream& stream) : set_(set), header_(*set.header), stream_(stream) {}
  void receive(messages::MessageRef message) override {
    // which entity sent it
    const messages::MessageRef its_own{set_.header, message.header};
    const bool has_own = message.header != nullptr;
    if (write_packet(has_own ? its_own : header_, message, set_.order, packet_))
      stream_.put(FrameKind::message, packet_);
  }

 private:
  const messages::MessageSet& set_;
  messages::Message header_;
  std::vector<std::byte> packet_;
  FrameStream& stream_;
};

/// Takes messages out of them.
class Taker {
 public:
  explicit Taker(const messages::MessageSet& set) : reader_(set) {}
  messages::MessageRef message(const FrameStream::Frame& frame) {
    if (reader_.read(frame.bytes) != messages::PacketError::none)
      throw FrameError("a frame of the lockstep protocol has a message that can't be read");
    return reader_.message();
  }

 private:
  messages::PacketReader reader_;
};

}  // namespace jarol::distributers
