#include "distributers/links/ownership.h"

#include <algorithm>
#include <utility>

namespace jarol::distributers {
namespace {

constexpr std::size_t max_listed = 16;  // strangers, and takeovers

}  // namespace

void Ownership::begin(Clock::time_point now) {
  owner_.reset();
  if (named_) owner_ = named_;
  begin_ = looked_ = now;
  silence_ = {};
}

void Ownership::look(Clock::time_point now) {
  silence_ += std::min<Clock::duration>(now - std::exchange(looked_, now), 2 * look_interval);
}

void Ownership::heard(const Address& sender, Clock::time_point now) {
  look(now);
  silence_ = {};
  if (owner_ && *owner_ == sender) return;
  if (owner_) {
    const std::lock_guard lock(mutex_);
    ++takeover_count_;
    if (takeovers_.size() < max_listed) takeovers_.push_back({owner_->text(), sender.text(), now - begin_});
  }
  owner_ = sender;
}

void Ownership::gone() {
  if (!named_) owner_.reset();
}

void Ownership::count_stranger(const Address& sender) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(strangers_.begin(), strangers_.end(), [&](const Stranger& s) { return s.address == sender; });
  if (found != strangers_.end())
    ++found->times;
  else if (strangers_.size() < max_listed)
    strangers_.push_back({sender, 1});
  else
    ++more_strangers_;
}

void Ownership::add_to(LinkReport& report) const {
  const std::lock_guard lock(mutex_);
  for (const Stranger& stranger : strangers_) report.strangers.push_back({stranger.address.text(), stranger.times});
  report.more_strangers = more_strangers_;
  report.takeovers = takeovers_;
}

std::uint64_t Ownership::takeovers() const {
  const std::lock_guard lock(mutex_);
  return takeover_count_;
}

}  // namespace jarol::distributers
