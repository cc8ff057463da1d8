// Times of the analysis are counted in ns.
#pragma once

#include <cstdint>

namespace jarol::tests {
inline constexpr std::int64_t ms = 1'000'000;
}  // namespace jarol::tests
