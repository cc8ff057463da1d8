// Small damages to a text, the same for the same seed.
#pragma once

#include <cstdint>
#include <string>

namespace jarol::tests {

/// The text with one to eight damages: characters changed, removed, doubled, swapped, pieces moved, words of YAML put
/// in.
std::string mutate(std::string text, std::uint64_t seed);

}  // namespace jarol::tests
