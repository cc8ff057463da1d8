// Where a foot of the helicopter may stand: it leans as far as its altitude has room for.
#pragma once

#include <algorithm>
#include <cmath>

#include "graph/values/describe.h"

namespace jarol::tasks {

struct FootStand {
  double foot = 0.2;
  double near = 0.01;

  static constexpr auto fields() {
    return describe(field<&FootStand::foot>("m", "of a foot from the axis").in(0.01, 10),
                    field<&FootStand::near>("m", "of altitude, above that at which the lowest foot stands").in(-1, 1));
  }
};

/// Roll and pitch in rad, the altitude of the vehicle above where it stands level in m:
///   altitude < foot sin(max(|roll|, |pitch|)) + near
inline bool may_stand(const FootStand& p, double roll, double pitch, double altitude) {
  return altitude < p.foot * std::sin(std::max(std::abs(roll), std::abs(pitch))) + p.near;
}

}  // namespace jarol::tasks
