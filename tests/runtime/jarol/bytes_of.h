// A text as the bytes that a port takes.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace jarol::tests {
inline std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }
}  // namespace jarol::tests
