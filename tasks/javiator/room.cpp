#include "tasks/javiator/room.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jarol::tasks {

WallFix find_place(const Room& room, const Eigen::Vector3d& lever_n, const Eigen::Vector3d& along_n, double range,
                   const Eigen::Vector2d& expected) {
  WallFix fix;
  if (!(range > 0)) return fix;
  const double ahead[] = {room.north, room.east}, behind[] = {-room.south, -room.west};
  double nearest = std::numeric_limits<double>::infinity(), next = nearest, margin = room.sight.corner;
  for (const int axis : {0, 1}) {
    const double along = along_n[axis];
    if (along == 0) continue;
    const double wall = (along > 0 ? ahead[axis] : behind[axis]) - lever_n[axis];
    const double away = (wall - expected[axis]) / along;
    const double error = room.sight.place_error / std::abs(along);
    if (away < -error) continue;
    margin += error;
    next = std::min(next, std::max(away, nearest));
    if (away >= nearest) continue;
    nearest = away;
    fix = {std::abs(along) >= room.sight.grazing, false, axis, wall - range * along};
  }
  fix.at_corner = next - nearest < margin || (nearest < next && !fix.seen);
  return fix;
}

}  // namespace jarol::tasks
