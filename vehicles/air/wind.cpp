#include "vehicles/air/wind.h"

#include <cmath>

namespace jarol::vehicles {

void Wind::step(double seconds) {
  if (parameters_.gusts == 0.0) return;
  const double kept = std::exp(-seconds / parameters_.gust_time);
  const double fresh = parameters_.gusts * std::sqrt(1.0 - kept * kept);
  for (double& gust : gust_) gust = kept * gust + fresh * noise_.normal();
}

fossen::Vector3 Wind::now() const {
  return {parameters_.north + gust_[0], parameters_.east + gust_[1], parameters_.down + gust_[2]};
}

}  // namespace jarol::vehicles
