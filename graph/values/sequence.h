// Values of changing size: Sequence<T> and String. They live in the memory of their owner, a task's private heap or a
// communicator's memory, and keep it when something is assigned to them: an assignment is always a deep copy into the
// room that is there, or into more of the owner's. Locals of a task live in its scratch.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "graph/values/heap.h"

namespace jarol {
namespace detail {

// Lets all values of changing size in `value` live in `memory`; found again in type_of.h for described types.
template <class T>
void adopt(T& value, std::pmr::memory_resource* memory);

}  // namespace detail

/// A list of values of any length, with the interface of a vector.
template <class T>
class Sequence {
 public:
  using value_type = T;

  Sequence() = default;
  Sequence(std::initializer_list<T> elements) { assign(elements.begin(), elements.size()); }
  Sequence(const Sequence& other) { assign(other.data_, other.size_); }
  Sequence(Sequence&& other) noexcept
      : memory_(other.memory_), data_(other.data_), size_(other.size_), capacity_(other.capacity_) {
    other.forget();
  }
  Sequence& operator=(const Sequence& other) {
    if (this != &other) assign(other.data_, other.size_);
    return *this;
  }
  // what lies in other memory is copied: an owner's memory is never exchanged
  Sequence& operator=(Sequence&& other) {
    if (this == &other) return *this;
    if (memory_ != nullptr && memory_ != other.memory_) return *this = static_cast<const Sequence&>(other);
    release();
    memory_ = other.memory_;
    data_ = other.data_;
    size_ = other.size_;
    capacity_ = other.capacity_;
    other.forget();
    return *this;
  }
  ~Sequence() { release(); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t capacity() const { return capacity_; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

  T& operator[](std::size_t i) {
    assert(i < size_);
    return data_[i];
  }
  const T& operator[](std::size_t i) const {
    assert(i < size_);
    return data_[i];
  }
  /// Throws std::out_of_range.
  T& at(std::size_t i) { return data_[checked(i)]; }
  const T& at(std::size_t i) const { return data_[checked(i)]; }
  T& front() { return (*this)[0]; }
  const T& front() const { return (*this)[0]; }
  T& back() { return (*this)[size_ - 1]; }
  const T& back() const { return (*this)[size_ - 1]; }

  void push_back(const T& value) {
    if (size_ == capacity_) {
      const T copy(value);  // it may be one of ours
      reserve(grown(size_ + 1));
      add() = copy;
      return;
    }
    add() = value;
  }

  void pop_back() {
    assert(size_ > 0);
    std::destroy_at(data_ + --size_);
  }

  void clear() { shrink(0); }

  /// New elements are default values.
  void resize(std::size_t size) {
    if (size < size_) return shrink(size);
    if (size > capacity_) reserve(grown(size));
    while (size_ < size) add();
  }

  void reserve(std::size_t capacity) {
    if (capacity <= capacity_) return;
    const Room room = allocate(capacity);
    if constexpr (std::is_trivially_copyable_v<T>) {
      if (size_ > 0) std::memcpy(static_cast<void*>(room.data), data_, size_ * sizeof(T));
    } else {
      std::uninitialized_move_n(data_, size_, room.data);
      std::destroy_n(data_, size_);
    }
    free_room();
    data_ = room.data;
    capacity_ = room.capacity;
  }

  friend bool operator==(const Sequence& a, const Sequence& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

  /// Its elements are those that lie there, in `memory`; what it had is forgotten, and not given back.
  void lie_in(std::pmr::memory_resource* memory, void* elements, std::size_t size, std::size_t capacity) {
    memory_ = memory;
    data_ = static_cast<T*>(elements);
    size_ = static_cast<std::uint32_t>(size);
    capacity_ = static_cast<std::uint32_t>(capacity);
  }

  /// Lives in `memory` from now on.
  void adopt(std::pmr::memory_resource* memory) {
    if (memory_ == memory) return;
    const Sequence kept(std::move(*this));
    memory_ = memory;
    assign(kept.data_, kept.size_);
  }

 private:
  static_assert(alignof(T) <= 16, "elements are aligned to at most 16 bytes");

  struct Room {
    T* data;
    std::uint32_t capacity;
  };

  Room allocate(std::size_t elements) {
    if (memory_ == nullptr) memory_ = memory_of_now();
    if (elements > 0xffffffffU / sizeof(T)) throw HeapExhausted(elements * sizeof(T), 0, 0xffffffffU);
    const std::size_t bytes = PrivateHeap::block_size(elements * sizeof(T));
    // all of the block is ours, so that it is known again when it is given back
    const auto capacity = static_cast<std::uint32_t>(bytes / sizeof(T));
    return {static_cast<T*>(memory_->allocate(capacity * sizeof(T), 16)), capacity};
  }

  std::size_t grown(std::size_t needed) const { return std::max<std::size_t>(needed, std::size_t{2} * capacity_); }

  std::size_t checked(std::size_t i) const {
    if (i >= size_) detail::throw_no_element(i, size_);
    return i;
  }

  // A default value at the end, for which there is room.
  T& add() {
    T* const added = new (static_cast<void*>(data_ + size_)) T{};
    ++size_;
    detail::adopt(*added, memory_);
    return *added;
  }

  void assign(const T* from, std::size_t size) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      if (size > capacity_) make_room(size);
      if (size > 0) std::memcpy(static_cast<void*>(data_), from, size * sizeof(T));
      size_ = static_cast<std::uint32_t>(size);
    } else {
      if (size > capacity_) reserve(size);  // the elements keep the rooms that they have
      if (size < size_) shrink(size);
      for (std::size_t i = 0; i < size_; ++i) data_[i] = from[i];
      while (size_ < size) add() = from[size_];  // the right side comes first
    }
  }

  // Without keeping what is there: the old room is free for the new one.
  void make_room(std::size_t size) {
    release();
    const Room room = allocate(size);
    data_ = room.data;
    capacity_ = room.capacity;
  }

  void shrink(std::size_t size) {
    std::destroy(data_ + size, data_ + size_);
    size_ = static_cast<std::uint32_t>(size);
  }

  void free_room() {
    if (data_ != nullptr) memory_->deallocate(data_, capacity_ * sizeof(T), 16);
    data_ = nullptr;
    capacity_ = 0;
  }

  void release() {
    shrink(0);
    free_room();
  }

  void forget() {
    data_ = nullptr;
    size_ = 0;
    capacity_ = 0;
  }

  std::pmr::memory_resource* memory_ = nullptr;  // null until something is stored
  T* data_ = nullptr;
  std::uint32_t size_ = 0;
  std::uint32_t capacity_ = 0;
};

/// Text of any length, in bytes.
class String {
 public:
  String() = default;
  String(std::string_view text) { *this = text; }
  String(const char* text) : String(std::string_view(text)) {}
  String& operator=(std::string_view text) {
    bytes_.resize(text.size());
    std::copy(text.begin(), text.end(), bytes_.begin());
    return *this;
  }
  String& operator=(const char* text) { return *this = std::string_view(text); }

  operator std::string_view() const { return view(); }
  std::string_view view() const { return {bytes_.data(), bytes_.size()}; }
  std::size_t size() const { return bytes_.size(); }
  bool empty() const { return bytes_.empty(); }
  void clear() { bytes_.clear(); }
  void push_back(char byte) { bytes_.push_back(byte); }
  /// New bytes are zero. Returns the first byte.
  char* resize(std::size_t size) {
    bytes_.resize(size);
    return bytes_.data();
  }
  String& operator+=(std::string_view text) {
    const std::size_t before = bytes_.size();
    const bool own = text.data() >= bytes_.data() && text.data() < bytes_.data() + before;
    const auto from = own ? text.data() - bytes_.data() : 0;
    bytes_.resize(before + text.size());
    const char* const source = own ? bytes_.data() + from : text.data();
    std::copy(source, source + text.size(), bytes_.begin() + before);
    return *this;
  }
  friend bool operator==(const String& a, const String& b) { return a.view() == b.view(); }
  friend bool operator==(const String& a, const char* b) { return a.view() == b; }

  void adopt(std::pmr::memory_resource* memory) { bytes_.adopt(memory); }
  std::size_t capacity() const { return bytes_.capacity(); }
  void lie_in(std::pmr::memory_resource* memory, void* bytes, std::size_t size, std::size_t capacity) {
    bytes_.lie_in(memory, bytes, size, capacity);
  }

 private:
  Sequence<char> bytes_;
};

}  // namespace jarol
