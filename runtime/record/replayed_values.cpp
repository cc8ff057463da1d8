#include "runtime/record/replayed_values.h"

#include <algorithm>

#include "graph/language/quantities.h"
#include "runtime/record/ros2msg.h"

namespace jarol {
namespace {
constexpr std::size_t none = static_cast<std::size_t>(-1);
}

ReplayedValues::ReplayedValues(const RecordedRun& run, const std::vector<Output>& outputs,
                               const std::vector<std::string>* only, Duration from)
    : run_(run), lane_of_(65536, none) {
  std::vector<bool> wanted(65536);
  for (const Output& output : outputs) {
    Lane lane{output.name, CdrEncoder(*output.type)};
    const bool asked = only == nullptr || std::find(only->begin(), only->end(), output.name) != only->end();
    const ReadTopic* const topic = asked ? run.recording().find(output.name) : nullptr;
    if (topic != nullptr && topic->schema == schema_of(*output.type).text) {
      lane.layout.emplace(*topic);
      wanted[topic->channel.id] = true;
      lane_of_[topic->channel.id] = lanes_.size();
      has_any_ = true;
    }
    lanes_.push_back(std::move(lane));
  }
  if (!has_any_) return;
  recorded_.emplace(run.recording(), std::move(wanted), from);
  end_ = run.covered();
  if (run.recording().is_whole()) return;
  // of the last instant that is there some may be missing
  end_ = Duration{};
  for (const ReadPlace& chunk : run.recording().chunks())
    for (std::size_t channel = chunk.min_channel; channel <= chunk.max_channel; ++channel)
      if (lane_of_[channel] != none) end_ = std::max(end_, Duration(chunk.end));
  // and the replay goes no further than the inputs are known
  end_ = std::min(end_, run.covered());
}

void ReplayedValues::take(Duration instant, std::uint32_t output, const void* value) {
  if (!wants(output) || instant >= end_) return;
  if (instant != instant_) compare_until(instant);
  instant_ = instant;
  const CdrEncoder& encoder = lanes_[output].encoder;
  std::string bytes(encoder.size(value), '\0');
  encoder.encode(value, reinterpret_cast<std::byte*>(bytes.data()));
  published_.push_back({output, std::move(bytes)});
}

void ReplayedValues::finish() {
  if (has_any_) compare_until(end_);
}

// All that was published and recorded before.
void ReplayedValues::compare_until(Duration end) {
  for (;;) {
    const mcap::Message* const next = recorded_->message();
    Duration instant = end;
    if (next != nullptr) instant = std::min(instant, Duration(next->time));
    if (!published_.empty()) instant = std::min(instant, instant_);
    if (instant >= end) return;
    std::vector<Published> is;
    if (!published_.empty() && instant_ == instant) is.swap(published_);
    compare_instant(instant, is);
  }
}

void ReplayedValues::compare_instant(Duration instant, std::vector<Published>& is) {
  std::vector<Published> was;
  for (const mcap::Message* next = recorded_->message(); next != nullptr && Duration(next->time) <= instant;
       recorded_->next(), next = recorded_->message())
    was.push_back({lane_of_[next->channel], std::string(next->data)});
  const auto by_name = [](const Published& a, const Published& b) { return a.lane < b.lane; };
  std::stable_sort(was.begin(), was.end(), by_name);
  std::stable_sort(is.begin(), is.end(), by_name);
  auto w = was.begin();
  auto i = is.begin();
  while (w != was.end() || i != is.end()) {
    const std::size_t lane = std::min(w != was.end() ? w->lane : none, i != is.end() ? i->lane : none);
    std::string_view before, now;
    const std::string_view *before_is = nullptr, *now_is = nullptr;
    if (w != was.end() && w->lane == lane) {
      before = (w++)->bytes;
      before_is = &before;
    }
    if (i != is.end() && i->lane == lane) {
      now = (i++)->bytes;
      now_is = &now;
    }
    if (before_is == nullptr && may_lack(instant)) continue;
    differences_.compare(instant, lanes_[lane].name, *lanes_[lane].layout, before_is, now_is);
  }
}

bool ReplayedValues::may_lack(Duration instant) const {
  return std::any_of(run_.gaps().begin(), run_.gaps().end(),
                     [&](const Gap& gap) { return Duration(gap.from) <= instant && instant <= Duration(gap.to); });
}

}  // namespace jarol
