#include "runtime/run/input_log.h"

#include "runtime/run/publisher.h"

namespace jarol {
namespace {
// in the order of log_outputs
enum Kind : std::uint32_t { misses, digests, rests };
}  // namespace

InputLog::InputLog(const Graph& graph, Recorder* to) : graph_(graph), to_(to) {
  if (to_ == nullptr) return;
  to_->expect(log_outputs(graph));
  const std::vector<std::size_t> inputs = logged_inputs(graph);
  output_of_.resize(graph.communicators.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) output_of_[inputs[i]] = static_cast<std::uint32_t>(i);
  inputs_ = static_cast<std::uint32_t>(inputs.size());
}

template <class Entry>
void InputLog::append(std::uint32_t kind, const Entry& entry, Duration instant) {
  if (to_ != nullptr) to_->append(instant, inputs_ + kind, &entry, sizeof entry);
}

void InputLog::took(std::size_t communicator, const void* value, Duration instant) {
  if (to_ == nullptr) return;
  record(*to_, output_of_[communicator], *graph_.communicators[communicator].type, value, instant);
}

void InputLog::late(std::uint32_t task, std::int64_t activation, std::optional<Duration> ended_after,
                    Duration instant) {
  append(misses, Miss{activation, ended_after ? ended_after->count() : Miss::unknown, task, 0}, instant);
}

void InputLog::left_out(std::uint32_t task, std::int64_t activation, Duration instant) {
  append(misses, Miss{activation, Miss::unknown, task, 1}, instant);
}

void InputLog::rest(Duration begun) { append(rests, RestBegin{begun.count()}, begun); }

void InputLog::checkpoint(Duration instant, Duration settled, std::uint64_t digest, bool exact) {
  checkpoint_due_ = instant + std::chrono::seconds(1);
  if (!to_->lost().empty()) return;
  append(digests, RunningDigest{settled.count(), digest, exact ? 1U : 0U}, instant);
  to_->hand_on();
}

}  // namespace jarol
