// What was shown so far, for pages that come later and those that are slow: messages in order, the oldest of which go
// when there is no room. Each page has a place in it.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>

namespace jarol::tools::console {

class History {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Text = std::shared_ptr<const std::string>;
  struct Message {
    Text text;  // null: there is none
    Time of{};  // when it was new
  };

  /// So many bytes at most, but for the newest message. `skips`: for pages that fall behind.
  explicit History(std::size_t room, bool skips = true) : room_(room), skips_(skips) {}

  void add(std::string message, Time now = {});

  /// Where a page is: the number of the message that it gets next.
  struct Place {
    std::uint64_t next = 0;
    std::uint64_t missed = 0;  // messages that were gone, or skipped, and that it was not informed of yet
    std::uint64_t before = 0;  // the messages before that number were there when it came
  };
  /// Of a page that comes now: it gets all that is there.
  Place begin() const { return {first_, 0, first_ + messages_.size()}; }
  /// Of one that gets only what comes from now on.
  Place end() const { return {first_ + messages_.size(), 0, first_ + messages_.size()}; }
  /// The next message for a page, if there is one now. One that has had all that was there before it and has fallen
  /// behind by more than `max_behind` messages goes on with the newest. `at_end`: that are all; who is slow goes on
  /// with the last few.
  Message next(Place& place, bool at_end = false) const;
  /// Of what time the next message is; null: there is none now.
  const Time* next_time(const Place& place) const;

  static constexpr std::uint64_t max_behind = 10;
  static constexpr std::uint64_t last_few = 3;

 private:
  std::uint64_t find_next(const Place& place, bool at_end) const;

  std::size_t room_, bytes_ = 0;
  bool skips_;
  std::uint64_t first_ = 0;  // number of the oldest
  std::deque<Message> messages_;
};

}  // namespace jarol::tools::console
