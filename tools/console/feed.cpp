#include "tools/console/feed.h"

#include <algorithm>
#include <utility>

namespace jarol::tools::console {

bool Batch::empty() const {
  return events.empty() && thinned == 0 && lost_events == 0 &&
         std::all_of(samples.begin(), samples.end(), [](const Samples& s) { return s.instants.empty(); });
}

Duration Batch::newest() const {
  Duration newest{};
  for (const Samples& each : samples)
    if (!each.instants.empty()) newest = std::max(newest, each.instants.back());
  return newest;
}

Feed::Feed(std::vector<const Type*> outputs, std::size_t max, std::vector<std::uint64_t> strides)
    : types_(std::move(outputs)),
      most_(std::max<std::size_t>(max, 2)),
      strides_(std::move(strides)),
      kept_(types_.size()),
      filling_(batches_.data()),
      spare_(&batches_[1]) {
  for (Batch& batch : batches_) batch.samples.resize(types_.size());
  begin();
}

const Batch& Feed::take_batch() {
  if (taken_ != nullptr) {
    // the recorder has not begun another one since
    if (spare_.load(std::memory_order_relaxed) != nullptr) return none_;
    spare_.store(taken_, std::memory_order_release);
  }
  // a spare one is there before what is ready goes
  taken_ = ready_.exchange(nullptr, std::memory_order_acq_rel);
  return taken_ != nullptr ? *taken_ : none_;
}

// With nothing in it, and all its memory. Where it stands in strides that were asked for goes on.
void Feed::begin() {
  for (Samples& samples : filling_->samples) samples.instants.clear();
  filling_->events.clear();
  filling_->thinned = filling_->lost_events = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i)
    kept_[i] = i < strides_.size() ? Kept{strides_[i], kept_[i].seen} : Kept{};
}

Batch& Feed::filling() {
  if (filling_ != nullptr) return *filling_;
  filling_ = ready_.exchange(nullptr, std::memory_order_acquire);
  if (filling_ != nullptr) return *filling_;  // nobody came for it
  filling_ = spare_.exchange(nullptr, std::memory_order_acquire);
  begin();
  return *filling_;
}

void Feed::pause() {
  if (filling_ != nullptr) ready_.store(std::exchange(filling_, nullptr), std::memory_order_release);
}

void Feed::take(Duration instant, std::uint32_t output, const void* value) {
  if (!wants(output) || types_[output] == nullptr) return;
  Batch& batch = filling();
  Samples& samples = batch.samples[output];
  Kept& kept = kept_[output];
  if (kept.newest_only) {
    samples.instants.pop_back();
    ++batch.thinned;
  } else if (samples.instants.size() == most_) {
    thin(samples, kept);
  }
  const std::size_t at = samples.instants.size();
  if (at == samples.values.size()) samples.values.emplace_back(*types_[output]);
  copy_value(*types_[output], samples.values[at].data(), value);
  samples.instants.push_back(instant);
  kept.newest_only = !kept.counts();
  ++kept.seen;
}

void Feed::thin(Samples& samples, Kept& kept) {
  std::size_t to = 0;
  for (std::size_t from = 0; from < samples.instants.size(); from += 2, ++to) {
    samples.instants[to] = samples.instants[from];
    std::swap(samples.values[to], samples.values[from]);
  }
  filling_->thinned += samples.instants.size() - to;
  samples.instants.resize(to);
  kept.stride *= 2;
}

void Feed::take_event(const RunEvent& event) {
  Batch& batch = filling();
  if (batch.events.size() == max_events) {
    ++batch.lost_events;
    return;
  }
  batch.events.push_back({event.kind, event.instant, event.task, event.activation, std::string(event.cause),
                          std::string(event.distributer)});
}

std::vector<const Type*> types_of_run(const Graph& graph, const std::vector<const Type*>& true_types) {
  std::vector<const Type*> types;
  for (const Output& output : outputs_of(graph)) types.push_back(output.type);
  types.insert(types.end(), true_types.begin(), true_types.end());
  return types;
}

}  // namespace jarol::tools::console
