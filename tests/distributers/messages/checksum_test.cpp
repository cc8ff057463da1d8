// Checksums against their published check values, and against a plain computation.
#include "distributers/messages/checksum.h"

#include <doctest/doctest.h>

#include <random>
#include <string_view>
#include <vector>

using namespace jarol::messages;

namespace {

std::uint16_t bit_by_bit(std::span<const std::byte> bytes) {
  std::uint16_t crc = 0;
  for (const std::byte b : bytes) {
    crc = static_cast<std::uint16_t>(crc ^ std::to_integer<std::uint16_t>(b));
    for (int bit = 0; bit < 8; ++bit) crc = static_cast<std::uint16_t>((crc >> 1) ^ ((crc & 1) != 0 ? 0xa001 : 0));
  }
  return crc;
}

}  // namespace

TEST_SUITE("distributers/messages/checksum") {
  TEST_CASE("of the digits 1 to 9, CRC-16/ARC is 0xbb3d, the sum 477") {
    const std::string_view digits = "123456789";
    CHECK(crc16_ibm(std::as_bytes(std::span(digits))) == 0xbb3d);
    CHECK(sum16(std::as_bytes(std::span(digits))) == 477);
  }

  TEST_CASE("eight bytes at once come to the same as bit by bit, for every length") {
    std::mt19937_64 random(6);
    std::vector<std::byte> bytes;
    for (int length = 0; length < 200; ++length) {
      CHECK(crc16_ibm(bytes) == bit_by_bit(bytes));
      bytes.push_back(static_cast<std::byte>(random()));
    }
  }
}
