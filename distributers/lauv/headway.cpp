#include "distributers/lauv/headway.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"

namespace jarol::distributers {
namespace {

using tasks::Course;

// m, of the way; 0: none, it is where it is to be.
double way_left(const HeadwayLimits& limits, const tasks::Leg& leg, const tasks::Progress& progress) {
  switch (leg.course) {
    case Course::line: return progress.near ? 0 : progress.distance;
    case Course::circle: return std::max(std::abs(progress.cross_track) - limits.circle, 0.0);
    case Course::station: return std::max(progress.distance - limits.station * leg.radius, 0.0);
    case Course::rest:
    case Course::fix:
    case Course::none: return 0;
  }
  return 0;
}

}  // namespace

std::string Headway::note(const HeadwayLimits& limits, const tasks::Leg& leg, const tasks::Progress& progress,
                          const tasks::Motion& motion, Duration now) {
  const bool by_level = leg.until_level, by_altitude = by_level && leg.vertical == tasks::Vertical::altitude;
  // how far it is to an altitude nobody says here: that it goes up or down has to do
  const double left = !by_level           ? way_left(limits, leg, progress)
                      : progress.levelled ? 0
                      : by_altitude       ? motion.z
                                          : std::abs(leg.level - motion.z);
  const bool is_there = by_level ? progress.levelled : left == 0;
  if (!left_ || is_there) {
    *this = {};
    left_ = left;
    looked_ = now;
    return "";
  }
  if (now - looked_ < limits.period) return "";
  const double way = *left_ - left;
  const bool comes_on = by_altitude ? std::abs(way) >= limits.level : way >= (by_level ? limits.level : limits.way);
  misses_ = comes_on ? 0 : misses_ + 1;
  left_ = left;
  looked_ = now;
  if (misses_ < limits.misses) return "";
  const std::string lost = fmt::format("no headway in {:.0f} s", seconds(limits.misses * limits.period));
  if (by_altitude) return lost + ", its altitude is not reached";
  return fmt::format("{}, {:.3g} m from its {}", lost, left, by_level ? "depth" : "place");
}

}  // namespace jarol::distributers
