#include "distributers/links/ownership.h"

#include <algorithm>
#include <utility>

namespace jarol::distributers {
namespace {

constexpr std::size_t max_listed = 16;  // peers, strangers, and takeovers

// False: it is not in the list, nor is there room for it.
template <class Listed>
bool count(std::vector<Listed>& list, const Address& address) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Listed& l) { return l.address == address; });
  if (found != list.end())
    ++found->times;
  else if (list.size() < max_listed)
    list.push_back({address, 1});
  else
    return false;
  return true;
}

}  // namespace

void Ownership::begin(Clock::time_point now) {
  for (Place& place : places_) place = {};
  begin_ = looked_ = now;
  if (!named_) return;
  places_.front().peer = named_;
  ++tenure_;
}

void Ownership::look(Clock::time_point now) {
  const auto time = std::min<Clock::duration>(now - std::exchange(looked_, now), 2 * look_interval);
  for (Place& place : places_) place.silence += time;
}

bool Ownership::is_owned() const {
  return std::any_of(places_.begin(), places_.end(), [](const Place& place) { return bool(place.peer); });
}

std::size_t Ownership::place_for(const Address& sender) const {
  std::size_t best = 0;
  const auto silence_at = [&](std::size_t i) { return places_[i].peer ? places_[i].silence : Clock::duration::max(); };
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i].peer == sender) return i;
    if (silence_at(i) > silence_at(best)) best = i;
  }
  return best;
}

bool Ownership::may_speak(const Address& sender) const {
  const std::size_t place = place_for(sender);
  return !places_[place].peer || places_[place].peer == sender || is_silent(place);
}

std::uint32_t Ownership::tenure_of(const Address& sender) const {
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (places_[i].peer && (places_[i].peer == sender || !is_silent(i))) return tenure_;
  return tenure_ + 1;
}

std::size_t Ownership::heard(const Address& sender, Clock::time_point now) {
  const std::size_t at = place_for(sender);
  tenure_ = tenure_of(sender);
  look(now);
  Place& place = places_[at];
  if (places_.size() > 1) count_heard(sender);
  if (place.peer && place.peer != sender) {
    const std::lock_guard lock(mutex_);
    ++takeover_count_;
    if (takeovers_.size() < max_listed) takeovers_.push_back({place.peer.text(), sender.text(), now - begin_});
  }
  place = {sender, {}};
  return at;
}

void Ownership::gone(std::size_t place) {
  if (!named_) places_[place] = {};
}

void Ownership::count_heard(const Address& sender) {
  const std::lock_guard lock(mutex_);
  count(peers_, sender);
}

void Ownership::count_stranger(const Address& sender) {
  const std::lock_guard lock(mutex_);
  if (!count(strangers_, sender)) ++more_strangers_;
}

void Ownership::add_to(LinkReport& report) const {
  const std::lock_guard lock(mutex_);
  for (const Listed& peer : peers_) report.peers.push_back({peer.address.text(), peer.times});
  for (const Listed& stranger : strangers_) report.strangers.push_back({stranger.address.text(), stranger.times});
  report.more_strangers = more_strangers_;
  report.takeovers = takeovers_;
}

std::uint64_t Ownership::takeovers() const {
  const std::lock_guard lock(mutex_);
  return takeover_count_;
}

}  // namespace jarol::distributers
