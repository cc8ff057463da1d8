// What a thread has seen of the memory: per place how new, per thread how much of it happened before.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace jarol::model {

inline constexpr std::size_t max_places = 16;
inline constexpr std::size_t max_threads = 5;  // the one that makes the program among them

inline std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9e3779b97f4a7c15ULL;
  return hash ^ (hash >> 29);
}

struct View {
  std::array<std::uint16_t, max_places> seen{};     // index of the newest store seen; older ones can't be read again
  std::array<std::uint16_t, max_threads> events{};  // so many events of that thread happened before

  void join(const View& other) {
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = std::max(seen[i], other.seen[i]);
    for (std::size_t i = 0; i < events.size(); ++i) events[i] = std::max(events[i], other.events[i]);
  }
  std::uint64_t hash(std::uint64_t h) const {
    for (const std::uint16_t s : seen) h = mix(h, s);
    for (const std::uint16_t e : events) h = mix(h, e);
    return h;
  }
};

}  // namespace jarol::model
