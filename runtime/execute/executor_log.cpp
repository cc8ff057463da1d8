// The executor as it logs what a replay needs.
#include <algorithm>

#include "runtime/execute/executor.h"

namespace jarol {

void Executor::begin_log() {
  options_.log->expect(log_outputs(graph_));
  const std::vector<std::size_t> inputs = logged_inputs(graph_);
  log_outputs_.resize(graph_.communicators.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) log_outputs_[inputs[i]] = static_cast<std::uint32_t>(i);
  log_misses_ = static_cast<std::uint32_t>(inputs.size());
}

void Executor::log_late(std::uint32_t task, std::int64_t activation, std::optional<Duration> ended_after,
                        std::int64_t instant) {
  log_miss({activation, ended_after ? ended_after->count() : Miss::unknown, task, 0}, instant);
}

void Executor::log_miss(const Miss& miss, std::int64_t instant) {
  if (options_.log == nullptr) return;
  options_.log->append(instant, log_misses_, &miss, sizeof miss);
}

void Executor::log_rest() {
  if (options_.log == nullptr) return;
  const RestBegin rest{rest_begun_.count()};
  options_.log->append(rest.begun, log_misses_ + 2, &rest, sizeof rest);
}

// At its beginning, when all that was due before the instant is known, but for data-flow tasks on threads that have not
// ended: whether one of them is late shows later.
void Executor::log_checkpoint(std::int64_t instant) {
  constexpr std::int64_t second = 1'000'000'000;
  checkpoint_due_ = instant + second;
  if (options_.log->has_lost()) return;
  Checkpoint checkpoint{instant, report_.digest, 1};
  for (const Activation* activation : under_way_) {
    checkpoint.settled = std::min(checkpoint.settled, threads_->tick(activation->task).now.count());
    checkpoint.exact = 0;
  }
  options_.log->append(instant, log_misses_ + 1, &checkpoint, sizeof checkpoint);
  options_.log->hand_on();
}

}  // namespace jarol
