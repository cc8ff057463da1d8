#include "distributers/session/status_events.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace jarol {
namespace {

struct Word {
  std::string name, meaning;
};

// Of a number that is no enumerator the number.
Word word_of(const Type& type, std::int64_t number) {
  for (std::size_t i = 0; i < type.enumerators.size(); ++i)
    if (type.enumerators[i].second == number) return {type.enumerators[i].first, type.meanings[i]};
  return {std::to_string(number), ""};
}

bool has_meaning(const Type& type) {
  return std::any_of(type.meanings.begin(), type.meanings.end(), [](const auto& meaning) { return !meaning.empty(); });
}

bool means_something(const Type& type, std::int64_t number) {
  for (std::size_t i = 0; i < type.enumerators.size(); ++i)
    if (type.enumerators[i].second == number) return !type.meanings[i].empty();
  return false;
}

}  // namespace

void StatusEvents::Watch::note(Duration instant, std::size_t watch, const void* value) {
  const Numbers before = now;
  const bool first = !std::exchange(begun, true);
  bool meant = false;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const Type& type = *leaves[i].type;
    now[i] = read_integer(type, static_cast<const std::byte*>(value) + leaves[i].offset);
    meant |= means_something(type, now[i]) || (!first && means_something(type, before[i]));
  }
  if (!meant || (!first && now == before)) return;
  if (kept.size() < max_kept) kept.push_back({instant, watch, before, now});
  ++count;
}

StatusEvents::StatusEvents(const Graph& graph) : graph_(graph) {
  const std::vector<Output> outputs = outputs_of(graph);
  watch_of_.resize(outputs.size());
  for (std::size_t i = 0; i < graph_.communicators.size(); ++i) {
    const Communicator& c = graph_.communicators[i];
    if (c.direction != Direction::out || !c.distributer) continue;
    Watch watch;
    watch.communicator = i;
    for (const Leaf& leaf : leaves_of(*c.type))
      if (leaf.type->kind == Kind::enumeration && watch.leaves.size() < max_leaves) watch.leaves.push_back(leaf);
    if (std::none_of(watch.leaves.begin(), watch.leaves.end(), [](const Leaf& l) { return has_meaning(*l.type); }))
      continue;
    const auto its = [&](const Output& output) { return output.name == c.name; };
    watch_of_[static_cast<std::size_t>(std::find_if(outputs.begin(), outputs.end(), its) - outputs.begin())] =
        watches_.size();
    watches_.push_back(std::move(watch));
  }
}

void StatusEvents::take(Duration instant, std::uint32_t output, const void* value) {
  if (!wants(output)) return;
  const std::lock_guard lock(mutex_);
  watches_[*watch_of_[output]].note(instant, *watch_of_[output], value);
}

void StatusEvents::serialize(Archive& archive) {
  const std::lock_guard lock(mutex_);
  archive.same(watches_.size(), "is of other outputs");
  for (Watch& watch : watches_) {
    archive(watch.begun, watch.now, watch.count, watch.kept);
    for (const Change& change : watch.kept)
      archive.require(change.watch < watches_.size() && watch.kept.size() <= watch.count, "is of other outputs");
  }
}

std::vector<StatusEvents::Change> StatusEvents::in_order() const {
  std::vector<Change> all;
  for (const Watch& watch : watches_) all.insert(all.end(), watch.kept.begin(), watch.kept.end());
  std::stable_sort(all.begin(), all.end(), [](const Change& a, const Change& b) { return a.instant < b.instant; });
  return all;
}

StatusEvents::Kept StatusEvents::kept() const {
  const std::lock_guard lock(mutex_);
  Kept all;
  std::vector<bool> begun(watches_.size(), false);
  for (const Change& change : in_order()) {
    const Watch& watch = watches_[change.watch];
    Event event{.communicator = graph_.communicators[watch.communicator].name, .instant = change.instant, .values = {}};
    for (std::size_t i = 0; i < watch.leaves.size(); ++i) {
      const Leaf& leaf = watch.leaves[i];
      Word word = word_of(*leaf.type, change.after[i]);
      event.values.push_back({leaf.path, std::move(word.name), std::move(word.meaning),
                              !begun[change.watch] || change.before[i] != change.after[i]});
    }
    begun[change.watch] = true;
    all.events.push_back(std::move(event));
  }
  for (const Watch& watch : watches_)
    if (watch.count > watch.kept.size())
      all.more.emplace_back(graph_.communicators[watch.communicator].name, watch.count - watch.kept.size());
  return all;
}

}  // namespace jarol
