// Whose link it is: a named peer's, or, without one, that of the first that speak validly, while they are heard: one,
// or as many as it has places for.
#pragma once

#include <chrono>
#include <mutex>
#include <vector>

#include "distributers/links/address.h"
#include "runtime/external_system.h"

namespace jarol::distributers {

/// All but `add_to` belongs to the thread that receives.
class Ownership {
 public:
  using Clock = std::chrono::steady_clock;
  /// After so long without anything valid another may take the link over.
  static constexpr std::chrono::milliseconds default_silence{5000};
  /// How often to look at least, so that a silence is measured.
  static constexpr std::chrono::milliseconds look_interval{100};

  static constexpr std::size_t max_places = 16;

  /// A named peer has the only place.
  explicit Ownership(std::chrono::nanoseconds silence = default_silence, const Address& named = {},
                     std::size_t places = 1)
      : limit_(silence), named_(named), places_(places) {}

  /// The link is connected: nobody owns it, or the named peer does. What was counted stays.
  void begin(Clock::time_point now);

  /// Time goes on. What takes much longer than a look was a halt of this machine, not a silence of the owner.
  void look(Clock::time_point now);

  std::size_t places() const { return places_.size(); }
  bool is_owned() const;
  bool is_owner(const Address& sender) const { return places_[place_for(sender)].peer == sender; }
  /// The owner at that place, which is not the named peer, has not been heard for the limit.
  bool is_silent(std::size_t place = 0) const {
    return !named_ && places_[place].peer && places_[place].silence >= limit_;
  }
  /// Does what that sender says count? It is an owner, or may become one.
  bool may_speak(const Address& sender) const;
  /// A number that a sender's packets have while it is an owner, or once it is. It is another than before if it comes
  /// when no other owner is there, or all others are silent: then the link had lost its peers.
  std::uint32_t tenure_of(const Address& sender) const;

  /// That sender, who may speak, has said something valid: it is an owner from now on, at the place returned.
  std::size_t heard(const Address& sender, Clock::time_point now);
  /// The owner is there no more: its port is closed, its stream has ended.
  void gone(std::size_t place = 0);

  void count_stranger(const Address& sender);

  /// From any thread.
  void add_to(LinkReport& report) const;
  std::uint64_t takeovers() const;

 private:
  std::chrono::nanoseconds limit_;
  Address named_;
  struct Place {
    Address peer{};  // none: it is free
    Clock::duration silence{};
  };
  std::vector<Place> places_;
  std::uint32_t tenure_ = 0;
  Clock::time_point begin_{}, looked_{};

  // its own; else a free one; else that of who has been silent for longest
  std::size_t place_for(const Address& sender) const;
  void count_heard(const Address& sender);

  struct Listed {
    Address address;
    std::uint64_t times;
  };
  mutable std::mutex mutex_;
  std::vector<Listed> peers_, strangers_;
  std::uint64_t more_strangers_ = 0, takeover_count_ = 0;
  std::vector<LinkReport::Takeover> takeovers_;
};

}  // namespace jarol::distributers
