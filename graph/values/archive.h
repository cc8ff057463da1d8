// The state of a run as one run of bytes: what saves it and what restores it is one function, `serialize(Archive&)`, so
// that the two can't part. Plain C++17, as units that include Simbody include it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "graph/text/errors.h"

namespace jarol {

struct Type;
template <class T>
const Type& type_of();

/// Bytes that are no state of what they are to restore; what, as in "ends within its state".
struct ArchiveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What has state that it can't save; the text says what.
struct NotSaveable : InputError {
  using InputError::InputError;
};

class Archive {
 public:
  using Bytes = std::vector<std::byte>;

  /// Appends what it is given. What is saved does not change.
  static Archive to(Bytes& bytes) { return Archive(&bytes, nullptr, nullptr); }
  /// Gives it back in the same order. Throws ArchiveError, and so does all below.
  static Archive from(const std::byte* begin, const std::byte* end) { return Archive(nullptr, begin, end); }
  static Archive from(const Bytes& bytes) { return from(bytes.data(), bytes.data() + bytes.size()); }

  bool restores() const { return to_ == nullptr; }
  /// Restoring: bytes that are left.
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  /// Restoring: nothing may be left.
  void require_end() const;
  /// Restoring: else the bytes are refused; `what` they have, as in "has a row that is not there".
  void require(bool good, const char* what) const;

  void bytes(void* data, std::size_t size);
  /// By its description; one of changing size in whatever memory it lives in. Saving, throws NotSaveable where that
  /// could not be restored: a bool with another byte than 0 or 1.
  void value(const Type& type, void* value);
  /// The same number when it is restored.
  void same(std::uint64_t number, const char* what);

  /// Numbers, enumerations, durations, texts, arrays, vectors, optionals and pairs of these, what is described, and
  /// whatever has a `serialize(Archive&)`.
  template <class... T>
  void operator()(T&... parts) {
    (part(parts), ...);
  }

 private:
  template <class T, class = void>
  struct HasSerialize : std::false_type {};
  template <class T>
  struct HasSerialize<T, std::void_t<decltype(std::declval<T&>().serialize(std::declval<Archive&>()))>>
      : std::true_type {};
  template <class T, class = void>
  struct IsDescribed : std::false_type {};
  template <class T>
  struct IsDescribed<T, std::void_t<decltype(T::fields())>> : std::true_type {};

  Archive(Bytes* to, const std::byte* begin, const std::byte* end) : to_(to), at_(begin), end_(end) {}

  std::size_t count(std::size_t now);

  void part(bool& flag);
  void part(std::string& text);
  void part(std::vector<bool>& flags);
  template <class Rep, class Period>
  void part(std::chrono::duration<Rep, Period>& duration) {
    Rep ticks = duration.count();
    bytes(&ticks, sizeof ticks);
    duration = std::chrono::duration<Rep, Period>(ticks);
  }
  template <class T, std::size_t N>
  void part(std::array<T, N>& all) {
    for (T& each : all) part(each);
  }
  template <class T>
  void part(std::vector<T>& all) {
    const std::size_t size = count(all.size());
    if (restores()) all.clear();
    for (std::size_t i = 0; i < size; ++i) {
      if (restores()) all.emplace_back();  // one by one: no more room than there are bytes
      part(all[i]);
    }
  }
  template <class A, class B>
  void part(std::pair<A, B>& both) {
    part(both.first);
    part(both.second);
  }
  template <class T>
  void part(std::optional<T>& maybe) {
    bool has = maybe.has_value();
    part(has);
    if (restores()) maybe = has ? std::optional<T>(std::in_place) : std::nullopt;
    if (has) part(*maybe);
  }
  template <class T>
  void part(T& each) {
    if constexpr (HasSerialize<T>::value) {
      each.serialize(*this);
    } else if constexpr (IsDescribed<T>::value) {
      value(type_of<T>(), &each);
    } else {
      static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "a part of a state has a serialize(Archive&)");
      bytes(&each, sizeof each);
    }
  }

  Bytes* to_;  // null: it restores
  const std::byte *at_, *end_;
};

}  // namespace jarol
