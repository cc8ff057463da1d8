#include "tools/console/unseen.h"

#include <fmt/format.h>

#include <stdexcept>

namespace jarol::tools::console {

void Unseen::send(Time of, Time now) {
  if (!says_ && all_.size() == max_kept) {
    all_.pop_front();
    ++seen_;
  }
  all_.push_back({of, now});
}

void Unseen::see(std::uint64_t messages) {
  const std::uint64_t sent = seen_ + all_.size();
  if (messages > sent || (says_ && messages < seen_))
    throw std::invalid_argument(
        fmt::format("'messages' of seen is {}, of {} that were sent and {} seen", messages, sent, says_ ? seen_ : 0));
  says_ = true;
  for (; seen_ < messages; ++seen_) all_.pop_front();
}

Duration Unseen::behind(Time now, const Time* next) const {
  if (!says_) return {};
  if (!all_.empty()) return now - all_.front().of;
  return next == nullptr ? Duration{} : now - *next;
}

}  // namespace jarol::tools::console
