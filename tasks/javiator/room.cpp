#include "tasks/javiator/room.h"

#include <cmath>
#include <limits>

namespace jarol::tasks {

WallFix find_place(const Room& room, const Eigen::Vector3d& lever_n, const Eigen::Vector3d& along_n, double range,
                   const Eigen::Vector2d& expected) {
  WallFix fix;
  if (!(range > 0)) return fix;
  const double ahead[] = {room.north, room.east}, behind[] = {-room.south, -room.west};
  double nearest = std::numeric_limits<double>::infinity();
  for (const int axis : {0, 1}) {
    const double along = along_n[axis];
    // a wall that is grazed has no place
    if (std::abs(along) < 0.1) continue;
    const double place = (along > 0 ? ahead[axis] : behind[axis]) - lever_n[axis] - range * along;
    const double off = std::abs((place - expected[axis]) / along);
    if (off >= nearest) continue;
    nearest = off;
    fix = {true, axis, place};
  }
  return fix;
}

}  // namespace jarol::tasks
