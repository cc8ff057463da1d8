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
    : types_(std::move(outputs)), most_(std::max<std::size_t>(max, 2)), strides_(std::move(strides)), kept_(begin()) {}

std::vector<Feed::Kept> Feed::begin() const {
  std::vector<Kept> kept(types_.size());
  for (std::size_t i = 0; i < std::min(kept.size(), strides_.size()); ++i) kept[i].stride = strides_[i];
  return kept;
}

Batch Feed::take_batch() {
  std::vector<Kept> kept = begin();
  Batch batch;
  {
    const std::lock_guard lock(mutex_);
    // where it stands in its strides goes on
    for (std::size_t i = 0; i < std::min(kept.size(), strides_.size()); ++i) kept[i].seen = kept_[i].seen;
    kept.swap(kept_);
    batch.events.swap(events_);
    batch.thinned = std::exchange(thinned_, 0);
    batch.lost_events = std::exchange(lost_events_, 0);
  }
  for (Kept& each : kept) batch.samples.push_back(std::move(each.samples));
  return batch;
}

void Feed::take(Duration instant, std::uint32_t output, const void* value) {
  if (!wants(output) || types_[output] == nullptr) return;
  const std::lock_guard lock(mutex_);
  Kept& kept = kept_[output];
  Samples& samples = kept.samples;
  if (kept.newest_only) {
    samples.instants.pop_back();
    samples.values.pop_back();
    ++thinned_;
  } else if (samples.instants.size() == most_) {
    thin(kept);
  }
  samples.instants.push_back(instant);
  copy_value(*types_[output], samples.values.emplace_back(*types_[output]).data(), value);
  kept.newest_only = !kept.counts();
  ++kept.seen;
}

void Feed::thin(Kept& kept) {
  Samples& all = kept.samples;
  std::size_t to = 0;
  for (std::size_t from = 0; from < all.instants.size(); from += 2, ++to) {
    all.instants[to] = all.instants[from];
    if (to != from) all.values[to] = std::move(all.values[from]);
  }
  thinned_ += all.instants.size() - to;
  all.instants.resize(to);
  all.values.resize(to);
  kept.stride *= 2;
}

void Feed::take_event(const RunEvent& event) {
  const std::lock_guard lock(mutex_);
  if (events_.size() == max_events) {
    ++lost_events_;
    return;
  }
  events_.push_back({event.kind, event.instant, event.task, event.activation, std::string(event.cause),
                     std::string(event.distributer)});
}

std::vector<const Type*> types_of_run(const Graph& graph, const std::vector<const Type*>& true_types) {
  std::vector<const Type*> types;
  for (const Output& output : outputs_of(graph)) types.push_back(output.type);
  types.insert(types.end(), true_types.begin(), true_types.end());
  return types;
}

}  // namespace jarol::tools::console
