// Memory for recorded values that are larger than a chunk of the recorder's ring: each takes the place of a chunk.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <new>

namespace jarol {

template <std::size_t Chunks>
class LargeValues {
 public:
  /// Memory of the chunk's place, at least that large: what it has, or new one; null: there is none. `let_go` returns
  /// when nothing in any place is needed any more; it is called before they take more than `max_kept` together.
  template <class LetGo>
  std::byte* room(std::size_t chunk, std::size_t bytes, const LetGo& let_go) {
    Place& place = places_[chunk];
    if (place.bytes >= bytes) return place.memory.get();
    place = {};
    std::size_t all = bytes;
    for (const Place& each : places_) all += each.bytes;
    if (all > max_kept && all > bytes && let_go()) places_ = {};
    place.memory.reset(new (std::nothrow) std::byte[bytes]);
    place.bytes = place.memory ? bytes : 0;
    return place.memory.get();
  }
  const std::byte* at(std::size_t chunk) const { return places_[chunk].memory.get(); }

  static constexpr std::size_t max_kept = std::size_t{64} << 20;

 private:
  struct Place {
    std::unique_ptr<std::byte[]> memory;
    std::size_t bytes = 0;
  };
  std::array<Place, Chunks> places_{};
};

}  // namespace jarol
