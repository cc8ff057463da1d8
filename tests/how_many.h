// How much a suite tries of what has no end: random graphs, damaged packets, seeds.
#pragma once

#include <cstdlib>

namespace jarol::tests {

/// JAROL_FULL=1: all that is worth trying, which takes hours.
inline bool is_full() { return std::getenv("JAROL_FULL") != nullptr; }

/// Builds with sanitizers or without optimisation try less: they are many times as slow, and what a test compares the
/// other builds compare; sanitizers look at how it is computed, which the first cases show.
#ifdef JAROL_TRIES_LESS
inline constexpr bool tries_less = true;
#else
inline constexpr bool tries_less = false;
#endif

/// How many cases a test tries: `usual`, or `full` with JAROL_FULL, or `less` where tries_less, if it takes long there.
template <class Count>
Count how_many(Count usual, Count full, Count less) {
  return is_full() ? full : tries_less ? less : usual;
}
template <class Count>
Count how_many(Count usual, Count full) {
  return how_many(usual, full, usual);
}

}  // namespace jarol::tests
