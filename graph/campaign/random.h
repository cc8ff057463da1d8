// Random numbers of campaigns: the same bits everywhere, from a seed and a place in the sequence.
#pragma once

#include <cstdint>

namespace jarol::campaign {

/// The number at a place of the sequence of a seed: splitmix64, whose state is seed + (place + 1) * its odd constant
/// (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014).
constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t place) {
  std::uint64_t z = seed + (place + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// In the middle of one of 2^52 equal parts of 0 to 1: never 0, never 1.
constexpr double part_of(std::uint64_t bits) { return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52; }

/// The standard normal deviate below which that part of all lies, 0 < part < 1.
double normal_quantile(double part);

}  // namespace jarol::campaign
