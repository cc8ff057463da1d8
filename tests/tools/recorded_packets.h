// Packets as a real DUNE sent them: records of a time, a length and a packet.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace jarol::test {

struct Packet {
  double seconds = 0;  // since the first of the recording
  std::vector<std::byte> bytes;
};

/// What was sent before `from`, labels alone, comes then.
inline std::vector<Packet> packets_of(const std::string& file, double from = 0) {
  std::ifstream in(file, std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::vector<Packet> packets;
  for (std::size_t at = 0; at + 10 <= all.size();) {
    Packet packet;
    std::uint16_t length = 0;
    std::memcpy(&packet.seconds, all.data() + at, 8);
    std::memcpy(&length, all.data() + at + 8, 2);
    packet.bytes.resize(length);
    std::memcpy(packet.bytes.data(), all.data() + at + 10, length);
    at += 10U + length;
    packet.seconds = std::max(packet.seconds, from);
    packets.push_back(std::move(packet));
  }
  return packets;
}

}  // namespace jarol::test
