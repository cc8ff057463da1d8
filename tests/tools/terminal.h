// A control terminal of the JAviator as the original behaves, on a socket of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "distributers/links/descriptor.h"

namespace jarol::tests {

class Terminal {
 public:
  enum class Over { udp, tcp };
  enum Key : std::uint8_t {
    switch_state = 0x11,
    switch_mode = 0x12,
    store_trim = 0x13,
    clear_trim = 0x14,
    shut_down = 0x15
  };

  struct Needles {
    std::int16_t roll = 0, pitch = 0, yaw = 0, altitude = 0;  // mrad, mm
  };
  struct Report {
    std::int16_t roll = 0, pitch = 0, yaw = 0, x = 0, y = 0, z = 0;  // mrad, mm
    std::int16_t front = 0;                                          // signal of that motor
    int state = 0, mode = 0;
  };

  /// Connects to 127.0.0.1; over UDP it says hello.
  Terminal(int port, Over over);

  void press(Key key) { send(key, {}); }

  /// Waits for the next report and the trace after it, and answers the report. None, if none comes in 20 s.
  std::optional<Report> answer();

  /// The same, without an answer.
  std::optional<Report> read();

  Needles needles;
  std::uint64_t sent = 0;  // packets
  std::uint64_t bad = 0;   // packets that came and were not as they have to be

 private:
  void send(std::uint8_t type, std::span<const std::int16_t> words);
  struct Packet {
    std::uint8_t type = 0;
    std::vector<std::uint8_t> payload;
  };
  // The next packet, if one comes in time.
  std::optional<Packet> receive();
  static Report report_of(const Packet& packet);

  distributers::Descriptor socket_;
  bool stream_ = false;
  bool met_ = false;
  std::vector<std::uint8_t> pending_;
};

}  // namespace jarol::tests
