#include "distributers/messages/checksum.h"

#include <array>

namespace jarol::messages {
namespace {

// tables[k][b]: what byte b adds to the remainder when k bytes follow it, so that eight are looked up at once
constexpr auto crc_tables = [] {
  std::array<std::array<std::uint16_t, 256>, 8> tables{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t crc = b;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xa001U : 0);
    tables[0][b] = static_cast<std::uint16_t>(crc);
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t b = 0; b < 256; ++b) {
      const std::uint32_t before = tables[k - 1][b];
      tables[k][b] = static_cast<std::uint16_t>((before >> 8) ^ tables[0][before & 0xff]);
    }
  return tables;
}();

}  // namespace

std::uint16_t crc16_ibm(std::span<const std::byte> bytes) {
  std::uint32_t crc = 0;
  const auto at = [&](std::size_t i) { return std::to_integer<std::uint32_t>(bytes[i]); };
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    const auto& t = crc_tables;
    crc = static_cast<std::uint32_t>(t[7][at(0) ^ (crc & 0xff)] ^ t[6][at(1) ^ (crc >> 8)] ^ t[5][at(2)] ^ t[4][at(3)] ^
                                     t[3][at(4)] ^ t[2][at(5)] ^ t[1][at(6)] ^ t[0][at(7)]);
  }
  for (const std::byte b : bytes) crc = (crc >> 8) ^ crc_tables[0][(crc ^ std::to_integer<std::uint32_t>(b)) & 0xff];
  return static_cast<std::uint16_t>(crc);
}

std::uint16_t sum16(std::span<const std::byte> bytes) {
  std::uint32_t sum = 0;
  for (const std::byte b : bytes) sum += std::to_integer<std::uint32_t>(b);
  return static_cast<std::uint16_t>(sum);
}

std::uint16_t checksum_of(Checksum kind, std::span<const std::byte> bytes) {
  switch (kind) {
    case Checksum::none: break;
    case Checksum::crc16_ibm: return crc16_ibm(bytes);
    case Checksum::sum16: return sum16(bytes);
  }
  return 0;
}

std::uint16_t checksum_of(const MessageSet& set, std::span<const std::byte> header_and_payload) {
  return checksum_of(set.checksum, header_and_payload.subspan(set.checksum_from));
}

}  // namespace jarol::messages
