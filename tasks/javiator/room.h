// Where a helicopter is in a room, by lasers that are fixed to it: its walls stand north, east, south and west.
#pragma once

#include <Eigen/Core>

#include "graph/values/describe.h"

namespace jarol::tasks {

/// Which of two walls a laser surely meets, and whether that has a place.
struct WallSight {
  double corner = 1;
  double place_error = 0.1;
  double grazing = 0.1;

  static constexpr auto fields() {
    using W = WallSight;
    return describe(
        field<&W::corner>("m", "by which a wall must be nearer along the ray than the other one").in(0, 100),
        field<&W::place_error>("m", "of the place expected: the more a ray grazes a wall, the nearer it must be")
            .in(0, 100),
        field<&W::grazing>("", "cosine of the angle to a wall's normal, below which it has no place").in(0, 1));
  }
};

struct Room {
  double north = 8, east = 8, south = 12, west = 12;
  WallSight sight{};

  static constexpr auto fields() {
    return describe(field<&Room::north>("m", "of where it started, its wall"), field<&Room::east>("m"),
                    field<&Room::south>("m"), field<&Room::west>("m"),
                    field<&Room::sight>("", "which of them a laser meets"));
  }
};

/// What one range says: the place along one axis, north or east; nothing if no wall is that way.
struct WallFix {
  bool seen = false;
  bool at_corner = false;  // it may be the other wall
  int axis = 0;            // 0 north, 1 east
  double place = 0;
};

/// A laser that stands at `lever_n` from the centre of gravity and looks along `along_n` has measured a range; it has
/// met the wall that is nearer that way from the place expected. A range of 0 is that of nothing. In m and NED, for
/// axis i, north or east:
///   away_i = (wall_i - lever_i - expected_i) / along_i,   wall_i ahead or behind by the sign of along_i
///   place = wall_i - lever_i - range along_i, of the nearer wall that is not behind, where |along_i| >= grazing
/// It may be a corner where the other wall is farther by less than corner, and place_error / |along_i| of both.
WallFix find_place(const Room& room, const Eigen::Vector3d& lever_n, const Eigen::Vector3d& along_n, double range,
                   const Eigen::Vector2d& expected);

}  // namespace jarol::tasks
