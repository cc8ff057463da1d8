// What a run has said its digest is.
#pragma once

#include <string>

namespace jarol::tests {
// as 0x0123456789abcdef; where none is said, all of the output, so that a failed check shows it
inline std::string digest_in(const std::string& output) {
  const std::size_t at = output.find("digest      0x");
  return at == std::string::npos ? output : output.substr(at + 12, 18);
}
}  // namespace jarol::tests
