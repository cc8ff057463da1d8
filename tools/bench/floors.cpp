#include "tools/bench/floors.h"

namespace jarol::bench {

double ChainFloor::run(std::uint64_t rounds) {
  for (std::uint64_t r = 0; r < rounds; ++r) {
    Message* published = nullptr;
    for (Place& place : places_) {
      if (published != nullptr) place.in = *published;
      pass_on(place.in, place.state, place.out);
      place.published = place.out;
      published = &place.published;
    }
  }
  return places_.back().out.words[7];
}

double FanFloor::run(std::uint64_t rounds) {
  for (std::uint64_t r = 0; r < rounds; ++r) {
    Place& source = places_[0];
    pass_on({}, source.state, source.out);
    for (std::size_t i = 1; i < places_.size(); ++i) {
      places_[i].in = source.out;
      pass_on(places_[i].in, places_[i].state, places_[i].out);
    }
  }
  return places_.back().out.words[7];
}

}  // namespace jarol::bench
