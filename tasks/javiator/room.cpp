#include "tasks/javiator/room.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jarol::tasks {
namespace {

// So much nearer than the other one a wall must be to be surely the one that is met, and more where the ray grazes one:
// the place that is expected may be off by that much.
constexpr double corner = 1.0;       // m
constexpr double place_error = 0.1;  // m
// Along a wall that is grazed more than this it has no place.
constexpr double grazing = 0.1;

}  // namespace

WallFix find_place(const Room& room, const Eigen::Vector3d& lever_n, const Eigen::Vector3d& along_n, double range,
                   const Eigen::Vector2d& expected) {
  WallFix fix;
  if (!(range > 0)) return fix;
  const double ahead[] = {room.north, room.east}, behind[] = {-room.south, -room.west};
  double nearest = std::numeric_limits<double>::infinity(), next = nearest, margin = corner;
  for (const int axis : {0, 1}) {
    const double along = along_n[axis];
    if (along == 0) continue;
    const double wall = (along > 0 ? ahead[axis] : behind[axis]) - lever_n[axis];
    const double away = (wall - expected[axis]) / along;
    const double error = place_error / std::abs(along);
    if (away < -error) continue;
    margin += error;
    next = std::min(next, std::max(away, nearest));
    if (away >= nearest) continue;
    nearest = away;
    fix = {std::abs(along) >= grazing, false, axis, wall - range * along};
  }
  fix.at_corner = next - nearest < margin || (nearest < next && !fix.seen);
  return fix;
}

}  // namespace jarol::tasks
