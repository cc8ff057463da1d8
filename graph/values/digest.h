// The digest of a trace: the wrapping sum of one hash per publication, so that parts can be summed
// apart. What depends on the value alone is summed here, word by word.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace jarol::digest {

__extension__ using Wide = unsigned __int128;

/// Low half xor high half of the 128-bit product.
constexpr std::uint64_t fold(std::uint64_t a, std::uint64_t b) {
  const Wide product = static_cast<Wide>(a) * b;
  return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
}

/// K_i: the i-th output of splitmix64 from seed 0 (Steele, Lea, Flood 2014), in closed form.
constexpr std::uint64_t key(std::uint64_t i) {
  std::uint64_t z = (i + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

namespace detail {
inline constexpr std::size_t table_size = 256;
inline constexpr auto keys = [] {
  std::array<std::uint64_t, table_size> table{};
  for (std::size_t i = 0; i < table_size; ++i) table[i] = key(i);
  return table;
}();
}  // namespace detail

/// Sum of the words of one value, in the order of its description.
class Words {
 public:
  void add(std::uint64_t word) {
    const std::size_t i = 2 * index_++ + 4;
    if (i + 1 < detail::table_size) {
      sum_ += fold(word ^ detail::keys[i], detail::keys[i + 1]);
    } else {
      sum_ += fold(word ^ key(i), key(i + 1));
    }
  }
  std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 0;
  std::size_t index_ = 0;
};

/// XXH64 (seed 0) of the name of an output, "task.output" or "communicator".
std::uint64_t name_hash(std::string_view name);

/// The part of a hash that all publications of one instant share.
constexpr std::uint64_t instant_term(std::int64_t nanoseconds) {
  return fold(static_cast<std::uint64_t>(nanoseconds) ^ key(2), key(3));
}

/// The hash of one publication.
constexpr std::uint64_t publication(std::uint64_t name, std::uint64_t instant, std::uint64_t words) {
  return fold((name + instant + words) ^ key(0), key(1));
}

}  // namespace jarol::digest
