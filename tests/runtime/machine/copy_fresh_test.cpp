#include "runtime/machine/copy_fresh.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>

namespace {
using namespace jarol;

template <std::size_t Bytes>
void check_copy() {
  // signalling and quiet NaNs, subnormal numbers and texts are bits like others
  constexpr std::array<std::uint64_t, 8> words{0x7ff0000000000001, 0x7ff8000000000000, 1, 0xffffffffffffffff,
                                               0x8000000000000000, 0x6465736b746f7021, 0, 0x123456789abcdef0};
  for (std::size_t offset = 0; offset < 8; ++offset) {
    std::array<std::byte, 96> from{}, to{}, expected{};
    std::memcpy(from.data() + offset, words.data(), Bytes);
    std::memcpy(expected.data() + offset, words.data(), Bytes);
    copy_fresh<Bytes>(to.data() + offset, from.data() + offset);
    CHECK(to == expected);
  }
}
}  // namespace

TEST_SUITE("runtime/copy_fresh") {
  TEST_CASE("each bit arrives, and nothing beside them") {
    check_copy<16>();
    check_copy<32>();
    check_copy<64>();
  }
}
