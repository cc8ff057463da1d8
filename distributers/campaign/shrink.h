// From a run that is not good to the mildest that is so, too.
#pragma once

#include "distributers/campaign/run_one.h"

namespace jarol::campaign {

struct Shrunk {
  Start start{};               // of the mildest run that ends as the one to be shrunk
  Result result{};             // of that
  std::uint64_t tried = 0;     // runs
  bool at_the_middle = false;  // nothing has to be away from the middle of its range
};

/// Takes each value to the middle of its range or distribution, or to the first one of its list, and where that is too
/// far as near to it as a thousandth of the way: one path after the other, all others as they are by then. The seed
/// stays. `outcome`: what runs have to come to, by the same metric, condition, mishap, or task and cause. None: it was
/// to stop.
std::optional<Shrunk> shrink(Graphs& graphs, const Campaign& campaign, const Draws& draws, std::uint64_t index,
                             Outcome outcome, const Oversight& oversight);

}  // namespace jarol::campaign
