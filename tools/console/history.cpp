#include "tools/console/history.h"

#include <utility>

namespace jarol::tools::console {

void History::add(std::string message) {
  bytes_ += message.size();
  messages_.push_back(std::make_shared<const std::string>(std::move(message)));
  while (bytes_ > room_ && messages_.size() > 1) {
    bytes_ -= messages_.front()->size();
    messages_.pop_front();
    ++first_;
  }
}

History::Message History::next(Place& place) const {
  const std::uint64_t end = first_ + messages_.size();
  std::uint64_t from = std::max(place.next, first_);
  if (skips_ && place.caught_up && end - from > max_behind) from = end - 1;
  place.missed += from - place.next;
  place.next = from;
  if (from == end) {
    place.caught_up = true;
    return nullptr;
  }
  ++place.next;
  return messages_[static_cast<std::size_t>(from - first_)];
}

}  // namespace jarol::tools::console
