// The states that the search for the truth goes through: each packed into a number, and all that were seen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace jarol::truth {

__extension__ using Bits = unsigned __int128;

inline constexpr std::size_t max_tasks = 5, nobody = 7, root = ~std::size_t{0};

// A task's newest activation, and how long ago it arrived.
struct Slot {
  std::uint8_t age = 0;     // also without an activation; the next one arrives at the period
  std::uint8_t left = 0;    // that it may still run
  std::uint8_t wait = 0;    // that its release may still be delayed
  std::uint8_t budget = 0;  // that it may still be held up
  bool pending = false, released = false, started = false;

  Bits packed() const {
    return age | left << 5 | wait << 10 | budget << 14 | pending << 18 | released << 19 | started << 20;
  }
};

inline constexpr int slot_bits = 21;
inline constexpr std::size_t max_cores = 2;

struct State {
  std::array<Slot, max_tasks> slots;
  std::size_t judged = nobody;  // the task whose activation is held up; then its lateness counts,
  bool others = false;          // and that of all on its core, as nobody waited who would have interrupted
  // non-preemptive: what holds up a core, once, for how long yet, and whose `blocking` it is; did the core run anything
  // just before?
  std::array<std::uint8_t, max_cores> piece{}, whose{nobody, nobody};
  std::array<bool, max_cores> busy{};
};

inline Bits key_of(const State& s) {
  Bits key = s.judged << 1 | (s.others ? 1U : 0U);
  for (const Slot& slot : s.slots) key = key << slot_bits | slot.packed();
  for (std::size_t c = 0; c < max_cores; ++c)
    key = key << 8 | static_cast<Bits>(s.piece[c] | s.whose[c] << 4 | s.busy[c] << 7);
  return key;
}

inline State state_of(Bits key) {
  State s;
  const auto next = [&](int size) {
    const auto field = static_cast<std::uint8_t>(key & ((1U << size) - 1));
    key >>= size;
    return field;
  };
  for (std::size_t c = max_cores; c-- > 0;) {
    s.piece[c] = next(4);
    s.whose[c] = next(3);
    s.busy[c] = next(1) != 0;
  }
  for (std::size_t i = max_tasks; i-- > 0;) {
    Slot& slot = s.slots[i];
    for (std::uint8_t* field : {&slot.age, &slot.left}) *field = next(5);
    for (std::uint8_t* field : {&slot.wait, &slot.budget}) *field = next(4);
    for (bool* field : {&slot.pending, &slot.released, &slot.started}) *field = next(1) != 0;
  }
  s.others = next(1) != 0;
  s.judged = next(3);
  return s;
}

// All states seen, each with the one that led to it.
class Seen {
 public:
  struct Node {
    Bits key = 0;
    std::size_t from = root;
  };

  Seen() : places_(1024) {}
  const Node& operator[](std::size_t i) const { return nodes_[i]; }
  std::size_t size() const { return nodes_.size(); }
  void add(Bits key, std::size_t from) {
    if (2 * nodes_.size() >= places_.size()) grow();
    std::size_t& place = find(key);
    if (place != 0) return;
    nodes_.push_back({key, from});
    place = nodes_.size();
  }

 private:
  std::size_t& find(Bits key) {
    std::uint64_t hash = static_cast<std::uint64_t>(key >> 64) * 0x9e3779b97f4a7c15ULL;
    hash = (hash ^ static_cast<std::uint64_t>(key)) * 0xbf58476d1ce4e5b9ULL;
    hash ^= hash >> 29;
    std::size_t at = hash & (places_.size() - 1);
    while (places_[at] != 0 && !(nodes_[places_[at] - 1].key == key)) at = (at + 1) & (places_.size() - 1);
    return places_[at];
  }
  void grow() {
    places_.assign(2 * places_.size(), 0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) find(nodes_[i].key) = i + 1;
  }

  std::vector<Node> nodes_;
  std::vector<std::size_t> places_;  // into nodes_, from 1 on
};

}  // namespace jarol::truth
