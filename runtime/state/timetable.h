// When groups are due, instant by instant over one hyperperiod, where they are few and it is short.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graph/language/duration.h"

namespace jarol {

class Timetable {
 public:
  void reserve() {
    instants_.reserve(max_instants);
    due_.reserve(max_due);
  }

  void clear() {
    instants_.clear();
    due_.clear();
    at_ = 0;
  }

  bool empty() const { return instants_.empty(); }

  /// Writes an instant down, the time to the next one, and who is due at it; false: there is no room for it, and
  /// the timetable is empty.
  bool add(Duration to_next, std::span<const std::uint32_t> due) {
    if (instants_.size() == max_instants || due_.size() + due.size() > max_due) {
      clear();
      return false;
    }
    instants_.push_back({to_next, static_cast<std::uint32_t>(due_.size()), static_cast<std::uint32_t>(due.size())});
    due_.insert(due_.end(), due.begin(), due.end());
    return true;
  }

  /// Who is due at its next instant; after the last one the first comes again. `to_next`: from that instant to the one
  /// after it.
  std::span<const std::uint32_t> take(Duration& to_next) {
    const Instant& instant = instants_[at_];
    if (++at_ == instants_.size()) at_ = 0;
    to_next = instant.to_next;
    return {due_.data() + instant.first, instant.count};
  }

 private:
  static constexpr std::size_t max_instants = 128, max_due = 1024;

  struct Instant {
    Duration to_next;
    std::uint32_t first, count;  // in due_
  };

  std::vector<Instant> instants_;
  std::vector<std::uint32_t> due_;
  std::size_t at_ = 0;
};

}  // namespace jarol
