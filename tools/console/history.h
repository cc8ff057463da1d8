// What was shown so far, for pages that come later and those that are slow: messages in order, the oldest of which go
// when there is no room. Each page has a place in it.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>

namespace jarol::tools::console {

class History {
 public:
  using Message = std::shared_ptr<const std::string>;

  /// So many bytes at most, but for the newest message. `skips`: for pages that fall behind.
  explicit History(std::size_t room, bool skips = true) : room_(room), skips_(skips) {}

  void add(std::string message);

  /// Where a page is: the number of the message that it gets next.
  struct Place {
    std::uint64_t next = 0;
    std::uint64_t missed = 0;  // messages that were gone, or skipped, and that it was not informed of yet
    bool caught_up = false;    // it has had all once
  };
  /// Of a page that comes now: it gets all that is there.
  Place begin() const { return {first_, 0, false}; }
  /// The next message for a page, null: there is none now. One that has had all and has fallen behind by more than
  /// `max_behind` messages goes on with the newest.
  Message next(Place& place) const;

  static constexpr std::uint64_t max_behind = 150;

 private:
  std::size_t room_, bytes_ = 0;
  bool skips_;
  std::uint64_t first_ = 0;  // number of the oldest
  std::deque<Message> messages_;
};

}  // namespace jarol::tools::console
