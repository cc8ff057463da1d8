#include "distributers/session/replay.h"

#include <utility>

namespace jarol {
namespace {

class ReplayedFromState : public ExternalSystem {
 public:
  ReplayedFromState(std::unique_ptr<ExternalSystem> system, std::unique_ptr<ExternalSystem> replayed)
      : system_(std::move(system)), replayed_(std::move(replayed)) {}
  void reach(Duration instant) override { replayed_->reach(instant); }
  bool take(std::size_t channel, void* value) override { return replayed_->take(channel, value); }
  void hand_over(std::size_t channel, const void* value) override { replayed_->hand_over(channel, value); }
  void serialize(Archive& archive) override { system_->serialize(archive); }

 private:
  std::unique_ptr<ExternalSystem> system_, replayed_;
};

}  // namespace

std::vector<std::unique_ptr<ExternalSystem>> with_state_of(std::vector<std::unique_ptr<ExternalSystem>> systems,
                                                           std::vector<std::unique_ptr<ExternalSystem>> replayed) {
  std::vector<std::unique_ptr<ExternalSystem>> both;
  for (std::size_t i = 0; i < systems.size(); ++i)
    both.push_back(std::make_unique<ReplayedFromState>(std::move(systems[i]), std::move(replayed[i])));
  return both;
}

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
