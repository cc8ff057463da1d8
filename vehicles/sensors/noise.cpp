#include "vehicles/sensors/noise.h"

#include <cmath>
#include <numbers>

#include "graph/values/digest.h"

namespace jarol::vehicles {

double Noise::uniform() { return (static_cast<double>(digest::key(seed_ + drawn_++) >> 11) + 0.5) * 0x1p-53; }

// Box and Muller, "A Note on the Generation of Random Normal Deviates", 1958
double Noise::normal() {
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

// the waiting time of a Poisson process
double draw_begin(double at, double rate, std::uint64_t seed) {
  return rate > 0.0 ? at - std::log(Noise(seed).uniform()) / rate : at;
}

}  // namespace jarol::vehicles
