#include "distributers/messages/checksum.h"

#include <array>

namespace jarol::messages {
namespace {

constexpr auto crc_table = [] {
  std::array<std::uint16_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xa001U : 0);
    table[i] = static_cast<std::uint16_t>(crc);
  }
  return table;
}();

}  // namespace

std::uint16_t crc16_ibm(std::span<const std::byte> bytes) {
  std::uint32_t crc = 0;
  for (const std::byte b : bytes) crc = (crc >> 8) ^ crc_table[(crc ^ std::to_integer<std::uint32_t>(b)) & 0xff];
  return static_cast<std::uint16_t>(crc);
}

std::uint16_t sum16(std::span<const std::byte> bytes) {
  std::uint32_t sum = 0;
  for (const std::byte b : bytes) sum += std::to_integer<std::uint32_t>(b);
  return static_cast<std::uint16_t>(sum);
}

std::uint16_t checksum_of(const MessageSet& set, std::span<const std::byte> header_and_payload) {
  const auto summed = header_and_payload.subspan(set.checksum_from);
  switch (set.checksum) {
    case Checksum::none: break;
    case Checksum::crc16_ibm: return crc16_ibm(summed);
    case Checksum::sum16: return sum16(summed);
  }
  return 0;
}

}  // namespace jarol::messages
