#include "vehicles/wind.h"

#include <cmath>
#include <numbers>

#include "graph/values/digest.h"

namespace jarol::vehicles {

// Box and Muller, "A Note on the Generation of Random Normal Deviates", 1958, on splitmix64 by number
double Wind::draw_normal() {
  const auto uniform = [this] {
    return (static_cast<double>(digest::key(parameters_.seed * 0x9e3779b97f4a7c15ULL + drawn_++) >> 11) + 0.5) *
           0x1p-53;
  };
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

void Wind::step(double seconds) {
  if (parameters_.gusts == 0.0) return;
  const double kept = std::exp(-seconds / parameters_.gust_time);
  const double fresh = parameters_.gusts * std::sqrt(1.0 - kept * kept);
  for (double& gust : gust_) gust = kept * gust + fresh * draw_normal();
}

fossen::Vector3 Wind::now() const {
  return {parameters_.north + gust_[0], parameters_.east + gust_[1], parameters_.down + gust_[2]};
}

}  // namespace jarol::vehicles
