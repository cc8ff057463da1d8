// The floors: what the best plain code takes for the same bodies and the same bytes.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/bench/message.h"

namespace jarol::bench {

/// One place of a plain loop, laid out as densely as a task.
struct alignas(64) Place {
  Message in;
  Filter state;
  Message out;
  Message published;
};

/// A chain: each runs, publishes, and the next latches: two copies per activation. Returns a checksum.
class ChainFloor {
 public:
  explicit ChainFloor(std::size_t length) : places_(length) {}
  double run(std::uint64_t rounds);

 private:
  std::vector<Place> places_;
};

/// A fan: one runs, all others latch its output and run: one copy per activation.
class FanFloor {
 public:
  explicit FanFloor(std::size_t readers) : places_(readers + 1) {}
  double run(std::uint64_t rounds);

 private:
  std::vector<Place> places_;
};

}  // namespace jarol::bench
