// What a page was sent and has not yet said to have seen: how far it is behind what the run does, and whether it gets
// more. Between here and a page there is room for megabytes (sockets, a browser's queues), so that a page that is too
// slow would show what was minutes ago if it were sent all that it is ready to take.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "graph/language/duration.h"

namespace jarol::tools::console {

/// Of {"do": "seen", "messages": 12} the number; nothing: it is another message. Throws InputError where the
/// number is none.
std::optional<std::uint64_t> read_seen(const std::string& message);

class Unseen {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// A message that reports on that time was sent.
  void send(Time of, Time now);

  /// The page has seen so many since it came. Throws InputError where that is less than before, or more than
  /// were sent.
  void see(std::uint64_t messages);

  /// Of a page that says what it has seen: it did so within `patience`, or has seen all.
  bool has_room(Time now) const { return !said_ || all_.empty() || now - all_.front().sent <= patience; }

  /// Or it does not say.
  bool is_all_seen() const { return !said_ || all_.empty(); }

  /// How long ago it was what the page sees; zero where it has seen all, or does not say. `next`: of what time the
  /// message tells that is not even sent.
  Duration behind(Time now, const Time* next) const;

  static constexpr std::chrono::milliseconds patience{200};
  /// Of pages that don't say what they see no more is kept.
  static constexpr std::size_t max_kept = 1000;

 private:
  struct Sent {
    Time of, sent;
  };
  std::deque<Sent> all_;
  std::uint64_t gone_ = 0;             // no longer kept
  std::optional<std::uint64_t> said_;  // to be seen
};

}  // namespace jarol::tools::console
