#include "vehicles/air/wind.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph/values/seed.h"

namespace jarol::vehicles {

Wind::Wind(const AirParameters& parameters, std::uint64_t seed)
    : parameters_(parameters),
      noise_(seed),
      gust_begin_(draw_begin(parameters.gust.at, parameters.gust.chance, spread_seed(seed, "gust"))) {
  const double speed = std::hypot(parameters.north, parameters.east);
  if (!parameters.dryden || speed == 0.0) return;
  along_north_ = parameters.north / speed;
  along_east_ = parameters.east / speed;
}

void Wind::step(double seconds) {
  time_ += seconds;
  if (parameters_.gusts == 0.0) return;
  const double kept = std::exp(-seconds / parameters_.gust_time);
  const double fresh = parameters_.gusts * std::sqrt(1.0 - kept * kept);
  for (std::size_t i = 0; i < 3; ++i) {
    const double noise = fresh * noise_.normal();
    if (!parameters_.dryden || i == 0) {
      gust_[i] = kept * gust_[i] + noise;
      continue;
    }
    // (1 + sqrt(3) T s) / (1 + T s)^2 of white noise (MIL-F-8785C), as sqrt(3) of a first-order process and
    // 1 - sqrt(3) of its lag; of both together the variance is 2
    constexpr double root = std::numbers::sqrt3;
    first_[i] = kept * first_[i] + noise;
    lagged_[i] += (1.0 - kept) * (first_[i] - lagged_[i]);
    gust_[i] = (root * first_[i] + (1.0 - root) * lagged_[i]) / std::numbers::sqrt2;
  }
}

fossen::Vector3 Wind::now(double height) const {
  const AirParameters& p = parameters_;
  // logarithmic law of the wall
  double part = 1.0;
  if (p.roughness > 0.0) part = std::log(std::max(height / p.roughness, 1.0)) / std::log(p.wind_height / p.roughness);
  double pulse = 0.0;
  if (time_ > gust_begin_ && time_ < gust_begin_ + p.gust.time)
    pulse = 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * (time_ - gust_begin_) / p.gust.time));
  const double north = along_north_ * gust_[0] - along_east_ * gust_[1];
  const double east = along_east_ * gust_[0] + along_north_ * gust_[1];
  return {part * p.north + north + pulse * p.gust.north, part * p.east + east + pulse * p.gust.east,
          p.down + gust_[2] + pulse * p.gust.down};
}

}  // namespace jarol::vehicles
