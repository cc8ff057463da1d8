// The secret that two processes share, so that each knows what the other has sent.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace jarol::distributers {

/// Made of all bytes of a file.
using SecretKey = std::array<std::byte, 32>;

/// Of a regular file of 32 to 4096 bytes that none but its owner may read or write. Throws InputError that
/// says what is wrong and what would be right.
SecretKey read_key(const std::string& path);

}  // namespace jarol::distributers
