// Checksums of packets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "distributers/messages/message_set.h"

namespace jarol::messages {

/// CRC-16/ARC: polynomial x^16 + x^15 + x^2 + 1, reflected, from 0; of "123456789" 0xBB3D.
std::uint16_t crc16_ibm(std::span<const std::byte> bytes);

/// Sum of the bytes modulo 65536.
std::uint16_t sum16(std::span<const std::byte> bytes);

/// Of that kind; 0 of none.
std::uint16_t checksum_of(Checksum kind, std::span<const std::byte> bytes);

/// The checksum of header and payload as the set wants it.
std::uint16_t checksum_of(const MessageSet& set, std::span<const std::byte> header_and_payload);

}  // namespace jarol::messages
