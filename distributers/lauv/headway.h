// Does a leg of a plan come on? The one of a vehicle that is held back, by a current say, is given up, as DUNE does.
#pragma once

#include <optional>
#include <string>

#include "graph/language/quantities.h"
#include "tasks/values/guidance.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {

/// Looks each 30 s how much is left of a leg: of the way to its place, until that is reached or a circle or station
/// kept, or to the depth at which it ends. Where three times in a row it was hardly less than before, there is no
/// headway. (DUNE's path control looks twice, after 15 s each, for 0.25 m/s; the slowest speed of a plan is less here.)
/// A leap of the place, or a turn back to a place that was missed, counts as one or two times.
class Headway {
 public:
  /// Of one leg, from its first progress on. Why it is to be given up, or nothing.
  std::string note(const tasks::Leg& leg, const tasks::Progress& progress, const tasks::Motion& motion, Duration now);

 private:
  std::optional<double> left_;  // m, when it was looked last
  Duration looked_{};
  int misses_ = 0;
};

}  // namespace jarol::distributers
