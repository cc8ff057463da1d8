// Numbers and texts of MCAP: written to the end of a buffer in little-endian order, and read from one.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "graph/language/duration.h"

namespace jarol::mcap {

/// Bytes that are no MCAP, and what is wrong with them, as in "a record that ends before its text".
struct FormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Texts = std::map<std::string, std::string>;

template <class T>
void put(std::string& to, T number) {
  static_assert(std::is_integral_v<T>);
  to.append(reinterpret_cast<const char*>(&number), sizeof number);
}

inline void put(std::string& to, Duration time) { put(to, std::int64_t{time.count()}); }

inline void put_text(std::string& to, std::string_view text) {
  put(to, static_cast<std::uint32_t>(text.size()));
  to += text;
}

inline void put_texts(std::string& to, const Texts& texts) {
  std::string all;
  for (const auto& [name, text] : texts) {
    put_text(all, name);
    put_text(all, text);
  }
  put_text(to, all);
}

/// Reads from the begin of bytes on.
class ByteCursor {
 public:
  explicit ByteCursor(std::string_view bytes) : left_(bytes) {}

  bool at_end() const { return left_.empty(); }

  template <class T>
  T number() {
    T value;
    std::memcpy(&value, bytes(sizeof value, "a number").data(), sizeof value);
    return value;
  }
  Duration time() { return Duration(number<std::int64_t>()); }
  std::string_view text() { return bytes(number<std::uint32_t>(), "its text"); }
  std::string_view long_bytes() { return bytes(number<std::uint64_t>(), "its bytes"); }
  Texts texts() {
    Texts all;
    for (ByteCursor in(text()); !in.at_end();) {
      const std::string name(in.text());
      all[name] = in.text();
    }
    return all;
  }

 private:
  std::string_view bytes(std::uint64_t count, const char* what) {
    if (count > left_.size()) throw FormatError(std::string("a record that ends before ") + what);
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
  }

  std::string_view left_;
};

}  // namespace jarol::mcap
