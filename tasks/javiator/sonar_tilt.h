// How the helicopter leans over level ground, by the ranges of the four sonars on its arms.
#pragma once

#include <cstdint>
#include <optional>

#include "graph/values/describe.h"
#include "tasks/values/robostix.h"

namespace jarol::tasks {

/// Four sonars over a plane: the filter looks for it with one of these, and the observer without an IMU with another.
struct SonarPlane {
  double reach = 2.9;
  double jump = 0.03;

  static constexpr auto fields() {
    using S = SonarPlane;
    return describe(
        field<&S::reach>("m", "of a sonar: what is further off it does not see").in(0, 100),
        field<&S::jump>("m", "by which two opposite ranges together may differ from the other two").in(0, 10));
  }
};

/// Whether all see something, and it lies in one plane: front + rear = right + left.
bool see_plane(const SonarPlane& p, const SonarRanges& sonars);

/// Of the sonars front, right, rear and left, `arm` from the axis, which look along the body's z.
struct TiltBySonars {
  double arm = 0.2;
  SonarPlane plane{};
  double noise = 0.009;
  double age = 0.02;
  double mean_time = 2;
  double patience = 0.3;
  std::uint32_t repeats = 6;

  static constexpr auto fields() {
    using T = TiltBySonars;
    return describe(
        field<&T::arm>("m", "of each sonar from the axis").in(0.01, 10), field<&T::plane>("", "that they see"),
        field<&T::noise>("rad", "standard deviation of roll and pitch").in(1e-4, 1),
        field<&T::age>("s", "of ranges when they are used").in(0, 1),
        field<&T::mean_time>("s", "over which what roll and pitch of the IMU differ by is averaged").in(1, 1000),
        field<&T::patience>("s", "without ranges before they show nothing").in(0, 1),
        field<&T::repeats>("", "of all four ranges, from which on they are not used"));
  }
};

struct Tilt {
  double roll = 0, pitch = 0;  // rad
};

/// The ranges r of a plane below: tan(roll) = (left - right) / 2 arm, tan(pitch) = cos(roll) (front - rear) / 2 arm.
/// Nothing where they see none.
std::optional<Tilt> find_tilt(const TiltBySonars& p, const SonarRanges& sonars);

}  // namespace jarol::tasks
