// Does a leg of a plan come on? The one of a vehicle that is held back, by a current say, is given up, as DUNE does.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "graph/language/quantities.h"
#include "graph/values/describe.h"
#include "tasks/values/guidance.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {

/// What counts as headway.
struct HeadwayLimits {
  Duration period = std::chrono::seconds(30);
  std::uint32_t misses = 3;
  double way = 1.5;
  double level = 0.3;
  double circle = tasks::circle_edge;
  double station = tasks::station_edge;

  static constexpr auto fields() {
    using namespace std::chrono_literals;
    using L = HeadwayLimits;
    return describe(
        field<&L::period>("", "from one look at what is left of a leg to the next").in(1s, 1h),
        field<&L::misses>("", "looks in a row that find no headway, after which its plan is given up").in(1, 1000),
        field<&L::way>("m", "by which it comes nearer from look to look, at least").in(0, 1000),
        field<&L::level>("m", "the same for a leg that ends at a depth; by buoyancy alone it comes up by 1.2 m in 30 s")
            .in(0, 1000),
        field<&L::circle>("m", "off its circle up to which it is there, as guidance's miss").in(0, 1000),
        field<&L::station>("", "radii off its station up to which it is there, as guidance's station.edge")
            .in(1, 1000));
  }
};

/// Looks each period how much is left of a leg: of the way to its place, until that is reached or a circle or station
/// kept, or to the depth at which it ends. Where three times in a row (misses) it was hardly less than before, there is
/// no headway. (DUNE's path control looks twice, after 15 s each, for 0.25 m/s; the slowest speed of a plan is less
/// here.) A leap of the place, or a turn back to a place that was missed, counts as one or two times.
class Headway {
 public:
  /// Of one leg, from its first progress on. Why it is to be given up, or nothing.
  std::string note(const HeadwayLimits& limits, const tasks::Leg& leg, const tasks::Progress& progress,
                   const tasks::Motion& motion, Duration now);

 private:
  std::optional<double> left_;  // m, when it was looked last
  Duration looked_{};
  std::uint32_t misses_ = 0;
};

}  // namespace jarol::distributers
