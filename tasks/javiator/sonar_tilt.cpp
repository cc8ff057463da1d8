#include "tasks/javiator/sonar_tilt.h"

#include <algorithm>
#include <cmath>

namespace jarol::tasks {

std::optional<Tilt> find_tilt(const TiltBySonars& p, const SonarRanges& sonars) {
  const auto& [front, right, rear, left] = sonars.ranges;
  const bool sees = std::max({front, right, rear, left}) < p.reach;
  if (!sees || std::abs(front + rear - right - left) > p.jump) return std::nullopt;
  const double roll = std::atan((left - right) / (2 * p.arm));
  return Tilt{roll, std::atan(std::cos(roll) * (front - rear) / (2 * p.arm))};
}

}  // namespace jarol::tasks
