#include "vehicles/sea/waves.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"
#include "graph/text/errors.h"

namespace jarol::vehicles {
Waves::Waves(double height, double period, double direction)
    : amplitude_(0.5 * height), north_(std::cos(direction)), east_(std::sin(direction)) {
  if (height == 0.0) return;
  if (!(height > 0.0)) throw InputError("sea.wave_height must not be below zero");
  if (!(period > 0.0)) throw InputError("sea.wave_period must be above zero");
  frequency_ = 2.0 * pi / period;
  number_ = frequency_ * frequency_ / gravity;
  if (height * number_ > 2.0 * pi / 7.0)
    throw InputError("waves of this sea.wave_height and sea.wave_period would break; they are steeper than 1 in 7");
}

Water Waves::at(const fossen::Vector3& p_n, double seconds) const {
  if (still()) return {};
  const double phase = number_ * (north_ * p_n[0] + east_ * p_n[1]) - frequency_ * seconds;
  const double c = std::cos(phase), s = std::sin(phase);
  // no higher than a crest: linear theory knows no water above
  const double here = amplitude_ * std::exp(-number_ * std::max(p_n[2], -amplitude_)), speed = frequency_ * here;
  const double along = speed * c, down = -speed * s;
  // d/dt + along d/ds + down d/dz; the second part is of the order of the steepness
  const double along_s = -number_ * speed * s, along_z = -number_ * speed * c;
  const double down_s = -number_ * speed * c, down_z = number_ * speed * s;
  const double along_dot = frequency_ * speed * s + along * along_s + down * along_z;
  const double down_dot = frequency_ * speed * c + along * down_s + down * down_z;
  return {-amplitude_ * c,
          here * c,
          {north_ * along, east_ * along, down},
          {north_ * along_dot, east_ * along_dot, down_dot}};
}

}  // namespace jarol::vehicles
