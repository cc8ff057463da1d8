// A writing and a reading thread on a real port, as fast as they can.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "tests/how_many.h"

namespace jarol::tests {

/// As long as a test may write: a while, or with JAROL_FULL a hundred million values. Where there is room for one or
/// two only, each value is a hand-off to another processor: there a hundred million calls of write, those refused
/// included, for what a refused one looks at is written by the other thread just then.
class Stress {
 public:
  explicit Stress(bool hands_off = false) : hands_off_(hands_off) {}

  bool goes_on(std::uint64_t written, std::uint64_t calls) const {
    if (full_) return (hands_off_ ? calls : written) < 100'000'000;
    return written % 256 != 0 || std::chrono::steady_clock::now() < end_;
  }

 private:
  bool hands_off_;
  bool full_ = is_full();
  std::chrono::steady_clock::time_point end_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
};

/// Between two tries: awake for a while, as the other thread mostly needs only moments; then it may need a processor.
class Patience {
 public:
  void wait() {
    if (++tries_ % 4096 == 0) std::this_thread::yield();
  }

 private:
  std::uint64_t tries_ = 0;
};

/// Every word shows which value it belongs to.
struct Checked {
  std::array<std::uint64_t, 8> words{};
  void set(std::uint64_t number) {
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = number * (2 * i + 1);
  }
  bool whole() const {
    for (std::size_t i = 0; i < words.size(); ++i)
      if (words[i] != words[0] * (2 * i + 1)) return false;
    return true;
  }
};

/// What is wrong, or nothing. A plain port passes on every value, a push port some, both in order and whole; the last
/// one always arrives.
template <class Port>
std::string stress(std::size_t capacity) {
  constexpr bool pushes = requires(const Port& p) { p.lost(); };
  Port port(capacity);
  std::string wrong;
  std::uint64_t got = 0;
  std::atomic<std::uint64_t> count{~std::uint64_t{0}};
  std::atomic<bool> gave_up{false};
  std::thread reader([&] {
    Checked value;
    Patience patience;
    for (std::uint64_t last = 0; last < count && wrong.empty();) {
      if (!port.read(value)) {
        patience.wait();
        continue;
      }
      ++got;
      if (!value.whole()) wrong = "torn after " + std::to_string(last);
      const std::uint64_t number = value.words[0];
      if (number <= last || (!pushes && number != last + 1))
        wrong += std::to_string(number) + " after " + std::to_string(last);
      last = number;
    }
    gave_up = true;
  });
  Checked value;
  const Stress stress(capacity <= 2);
  Patience patience;
  std::uint64_t written = 0;
  std::uint64_t calls = 0;
  do {
    value.set(++written);
    while (++calls, !port.write(value) && !gave_up) patience.wait();
  } while (stress.goes_on(written, calls) && !gave_up);
  count = written;
  reader.join();
  if constexpr (pushes)
    if (wrong.empty() && got + port.lost() != count) wrong = "values lost without being counted";
  return wrong;
}

/// The same for packets: each byte shows the packet, whose number also gives its length.
template <class Port>
std::string stress_packets(std::size_t capacity) {
  constexpr bool pushes = requires(const Port& p) { p.lost(); };
  constexpr std::size_t longest = 1500;
  const auto length_of = [](std::uint64_t number) { return 8 + number * 977 % (longest - 7); };
  Port port(capacity, longest);
  std::string wrong;
  std::atomic<std::uint64_t> count{~std::uint64_t{0}};
  std::atomic<bool> gave_up{false};
  std::thread reader([&] {
    std::vector<std::byte> room(longest);
    Patience patience;
    for (std::uint64_t last = 0; last < count && wrong.empty();) {
      const auto length = port.read(room);
      if (!length) {
        patience.wait();
        continue;
      }
      std::uint64_t number = 0;
      std::memcpy(&number, room.data(), 8);
      bool whole = *length == length_of(number);
      for (std::size_t i = 8; whole && i < *length; ++i) whole = room[i] == static_cast<std::byte>(number * 31 + i);
      if (!whole) wrong = "torn after " + std::to_string(last);
      if (number <= last || (!pushes && number != last + 1))
        wrong += std::to_string(number) + " after " + std::to_string(last);
      last = number;
    }
    gave_up = true;
  });
  std::vector<std::byte> packet(longest);
  const Stress stress;
  Patience patience;
  std::uint64_t written = 0;
  do {
    const std::size_t length = length_of(++written);
    std::memcpy(packet.data(), &written, 8);
    for (std::size_t i = 8; i < length; ++i) packet[i] = static_cast<std::byte>(written * 31 + i);
    while (!port.write(std::span(packet).first(length)) && !gave_up) patience.wait();
  } while (stress.goes_on(written * 256, written * 256) && !gave_up);
  count = written;
  reader.join();
  return wrong;
}

}  // namespace jarol::tests
