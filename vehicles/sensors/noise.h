// Random numbers of one source of noise. Each source has a seed of its own, so that none depends on how often another
// draws.
#pragma once

#include <cstdint>

#include "graph/values/archive.h"

namespace jarol::vehicles {

class Noise {
 public:
  explicit Noise(std::uint64_t seed) : seed_(seed) {}

  /// Between 0 and 1, neither of them reached.
  double uniform();

  /// Mean 0, standard deviation 1.
  double normal();

  void serialize(Archive& archive) { archive(drawn_); }

 private:
  std::uint64_t seed_;
  std::uint64_t drawn_ = 0;
};

/// When something begins: at a time, or from then on by chance at a rate (1/s).
double draw_begin(double at, double rate, std::uint64_t seed);

/// From a begin on for so many seconds; 0: for good.
inline bool lasts_at(double seconds, double begin, double lasts) {
  return seconds >= begin && (lasts == 0.0 || seconds < begin + lasts);
}

}  // namespace jarol::vehicles
