// The slots of a port, one after the other: each some plain bytes, then atomic words.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <stdexcept>

#include "runtime/machine/memory.h"

namespace jarol {

template <class Memory>
class Slots {
 public:
  using Word = typename Memory::template Atomic<std::uint64_t>;

  /// All words are zero at first. Throws std::length_error for more than fits into memory.
  Slots(std::size_t count, std::size_t bytes, std::size_t words) : count_(count) {
    constexpr std::size_t max = std::size_t{1} << 40;
    if (bytes > max || words > max) throw std::length_error(too_much);
    words_at_ = round_up(bytes, sizeof(std::uint64_t));
    stride_ = round_up(std::max<std::size_t>(1, words_at_ + words * sizeof(Word)), line);
    if (count > max / stride_) throw std::length_error(too_much);
    memory_ = static_cast<std::byte*>(::operator new (count* stride_, std::align_val_t{apart}));
    for (std::size_t slot = 0; slot < count; ++slot)
      for (std::size_t i = 0; i < words; ++i) new (this->bytes(slot) + words_at_ + i * sizeof(Word)) Word(0);
  }
  ~Slots() { ::operator delete (memory_, std::align_val_t{apart}); }
  Slots(const Slots&) = delete;
  Slots& operator=(const Slots&) = delete;

  std::size_t count() const { return count_; }
  std::byte* bytes(std::size_t slot) const { return memory_ + slot * stride_; }
  Word* words(std::size_t slot) const { return std::launder(reinterpret_cast<Word*>(bytes(slot) + words_at_)); }
  /// The slot after this one, in a circle.
  std::size_t after(std::size_t slot) const { return slot + 1 == count_ ? 0 : slot + 1; }
  std::size_t before(std::size_t slot) const { return slot == 0 ? count_ - 1 : slot - 1; }

 private:
  static constexpr std::size_t line = 64;
  static constexpr const char* too_much = "the slots of a port take more than a tebibyte";

  static std::size_t round_up(std::size_t size, std::size_t step) { return (size + step - 1) / step * step; }

  std::size_t count_;
  std::size_t words_at_ = 0;
  std::size_t stride_ = 0;
  std::byte* memory_ = nullptr;
};

}  // namespace jarol
