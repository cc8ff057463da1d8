#include "tools/console/history.h"

#include <algorithm>
#include <utility>

namespace jarol::tools::console {

void History::add(std::string message, Time now) {
  bytes_ += message.size();
  messages_.push_back({std::make_shared<const std::string>(std::move(message)), now});
  while (bytes_ > room_ && messages_.size() > 1) {
    bytes_ -= messages_.front().text->size();
    messages_.pop_front();
    ++first_;
  }
}

std::uint64_t History::find_next(const Place& place, bool at_end) const {
  const std::uint64_t end = first_ + messages_.size(), from = std::max(place.next, first_);
  if (!skips_ || from < place.before || end - from <= (at_end ? last_few : max_behind)) return from;
  return at_end ? end - last_few : end - 1;
}

History::Message History::next(Place& place, bool at_end) const {
  const std::uint64_t from = find_next(place, at_end);
  place.missed += from - place.next;
  place.next = from;
  if (from == first_ + messages_.size()) return {};
  ++place.next;
  return messages_[static_cast<std::size_t>(from - first_)];
}

const History::Time* History::next_time(const Place& place) const {
  const std::uint64_t from = find_next(place, false);
  return from == first_ + messages_.size() ? nullptr : &messages_[static_cast<std::size_t>(from - first_)].of;
}

}  // namespace jarol::tools::console
