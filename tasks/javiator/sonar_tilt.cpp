#include "tasks/javiator/sonar_tilt.h"

#include <algorithm>
#include <cmath>

namespace jarol::tasks {

bool see_plane(const SonarPlane& p, const SonarRanges& sonars) {
  const auto& [front, right, rear, left] = sonars.ranges;
  const bool sees = std::max({front, right, rear, left}) < p.reach;
  return sees && std::abs(front + rear - right - left) <= p.jump;
}

std::optional<Tilt> find_tilt(const TiltBySonars& p, const SonarRanges& sonars) {
  const auto& [front, right, rear, left] = sonars.ranges;
  if (!see_plane(p.plane, sonars)) return std::nullopt;
  const double roll = std::atan((left - right) / (2 * p.arm));
  return Tilt{roll, std::atan(std::cos(roll) * (front - rear) / (2 * p.arm))};
}

}  // namespace jarol::tasks
