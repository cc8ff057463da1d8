// The check sum of MCAP: CRC-32 with the reflected polynomial 0xedb88320, as in zlib and PNG.
#pragma once

#include <cstdint>
#include <string_view>

namespace jarol::mcap {

/// Of bytes that follow those of which `before` is the sum.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

/// Of two runs of bytes one after the other, from the sum of each.
std::uint32_t joined_crc32(std::uint32_t first, std::uint32_t second, std::uint64_t bytes_of_second);

/// The same as crc32 without instructions that few processors have,
std::uint32_t crc32_by_narrow_folding(std::string_view bytes, std::uint32_t before = 0);
/// and without any that not every one has.
std::uint32_t crc32_by_table(std::string_view bytes, std::uint32_t before = 0);

}  // namespace jarol::mcap
