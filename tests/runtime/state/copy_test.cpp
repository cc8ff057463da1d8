#include "runtime/state/copy.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace {
using namespace jarol;
}  // namespace

TEST_SUITE("runtime/copy") {
  TEST_CASE("many values arrive bit for bit, of any size and at any place, and nothing beside them") {
    for (const bool wide : {false, has_wide_vectors})
      for (std::uint32_t size = 1; size <= 130; ++size)
        for (std::size_t offset = 0; offset < 8; ++offset) {
          constexpr std::size_t count = 9, apart = 160;
          std::array<std::byte, apart> from{};
          for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<std::byte>(i * 37 + 1);
          std::vector<std::byte> to(count * apart), expected(count * apart);
          std::vector<Copy> copies;
          for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = i * apart + offset;
            copies.push_back({from.data() + offset, to.data() + at, size});
            std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(offset), size,
                        expected.begin() + static_cast<std::ptrdiff_t>(at));
          }
          transfer_all({copies.data(), count}, wide);
          REQUIRE(to == expected);
        }
  }
}
