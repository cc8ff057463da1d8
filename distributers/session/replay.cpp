#include "distributers/session/replay.h"

namespace jarol {

void ReplayRun::cover() {
  const auto go_to = [&](Duration end) {
    executor_.run_until(end);
    comparison.interrupted = executor_.now() < end;
    return !comparison.interrupted;
  };
  for (const RunningDigest& digest : log_.digests()) {
    const Duration settled(digest.settled);
    if (!whole_ || digest.exact == 0 || comparison.diverged_until || settled > log_.covered()) continue;
    if (settled < executor_.now()) continue;  // before where it begins
    if (!go_to(settled)) return;
    (executor_.report().digest == digest.digest ? comparison.same_until : comparison.diverged_until) = settled;
  }
  if (!go_to(log_.covered())) return;
  const Report& report = executor_.report();
  const std::optional<LogEnd>& end = log_.end();
  const bool same = !whole_ || !end ||
                    (report.digest == end->digest && report.activations == end->activations &&
                     report.instants == end->instants && report.fault_count == end->faults);
  if (comparison.diverged_until || !same) {
    comparison.evidence = Evidence::diverged;
  } else if (end) {
    comparison.evidence = Evidence::same;
  }
}

}  // namespace jarol
