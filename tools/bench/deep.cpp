#include "tools/bench/deep.h"

#include <array>
#include <cstring>
#include <memory>

#include "runtime/state/copy.h"
#include "tools/bench/timing.h"

namespace jarol::bench {

Figure measure_deep(int repeats) {
  constexpr std::size_t readers = 8, numbers = 128;
  struct Memory {
    // at the begin of a cache line, as those of a run are
    alignas(64) std::array<std::byte, 64 << 10> region{};
    PrivateHeap heap{region.data(), region.size()};
    Sequence<double> source;
    std::array<Sequence<double>, readers> slots;
    std::vector<DeepCopy> deep;
    std::vector<Copy> copies;
    alignas(64) std::array<std::array<double, numbers>, readers + 1> plain{};
  };
  auto memory = std::make_shared<Memory>();
  memory->source.adopt(memory->heap.values());
  memory->source.resize(numbers);
  memory->deep.reserve(readers);
  for (Sequence<double>& slot : memory->slots) {
    slot.adopt(memory->heap.values());
    memory->deep.push_back(
        {&type_of<Sequence<double>>(), reinterpret_cast<const std::byte*>(&memory->source), nullptr});
    memory->copies.push_back({&memory->deep.back(), reinterpret_cast<std::byte*>(&slot), 0});
  }
  constexpr int rounds = 5'000;
  const auto per_copy = [](const std::function<void()>& work) { return 1e9 * seconds_of(work) / (rounds * readers); };
  Figure figure = compare(
      "deep_1k", "1 KiB sequence across a connection / memcpy", 0.7, repeats,
      [=] {
        return per_copy([&] {
          for (int r = 0; r < rounds; ++r) {
            memory->source[0] = r;
            for (const Copy& c : memory->copies) transfer(c);
          }
        });
      },
      [=] {
        return per_copy([&] {
          for (int r = 0; r < rounds; ++r) {
            memory->plain[readers][0] = r;
            for (std::size_t i = 0; i < readers; ++i) {
              std::memcpy(memory->plain[i].data(), memory->plain[readers].data(), sizeof memory->plain[i]);
              asm volatile("" ::: "memory");
            }
          }
        });
      });
  // the slots' memory is the heap's, which goes first
  keep(memory->slots[readers - 1][0]);
  return figure;
}

}  // namespace jarol::bench
