// The slots of a port, one after the other: each some atomic words, then plain bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <stdexcept>

#include "runtime/memory.h"

namespace jarol {

template <class Memory>
class Slots {
 public:
  using Word = typename Memory::template Atomic<std::uint64_t>;

  /// All words are zero at first. Throws std::length_error for more than fits into memory.
  Slots(std::size_t count, std::size_t words, std::size_t bytes) : count_(count), words_(words) {
    constexpr std::size_t most = std::size_t{1} << 40;
    if (count > most || words > most || bytes > most ||
        count * (line + bytes / line + words / line * sizeof(Word)) > most)
      throw std::length_error("the slots of a port take more than a tebibyte");
    stride_ = (words * sizeof(Word) + bytes + alignof(Word) - 1) / alignof(Word) * alignof(Word);
    memory_ = static_cast<std::byte*>(::operator new (count* stride_, std::align_val_t{apart}));
    for (std::size_t slot = 0; slot < count; ++slot)
      for (std::size_t i = 0; i < words; ++i) new (memory_ + slot * stride_ + i * sizeof(Word)) Word(0);
  }
  ~Slots() { ::operator delete (memory_, std::align_val_t{apart}); }
  Slots(const Slots&) = delete;
  Slots& operator=(const Slots&) = delete;

  std::size_t count() const { return count_; }
  Word* words(std::size_t slot) const { return std::launder(reinterpret_cast<Word*>(memory_ + slot * stride_)); }
  std::byte* bytes(std::size_t slot) const { return memory_ + slot * stride_ + words_ * sizeof(Word); }
  /// The slot after this one, in a circle.
  std::size_t after(std::size_t slot) const { return slot + 1 == count_ ? 0 : slot + 1; }
  std::size_t before(std::size_t slot) const { return slot == 0 ? count_ - 1 : slot - 1; }

 private:
  static constexpr std::size_t line = 64;

  std::size_t count_;
  std::size_t words_;
  std::size_t stride_ = 0;
  std::byte* memory_ = nullptr;
};

}  // namespace jarol
