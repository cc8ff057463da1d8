// Whose link it is: a named peer's, or, without one, that of the first that speaks validly, while it is heard.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>

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

  explicit Ownership(std::chrono::nanoseconds silence = default_silence, const Address& named = {})
      : limit_(silence), named_(named) {}

  /// The link is connected: nobody owns it, or the named peer does. What was counted stays.
  void begin(Clock::time_point now);

  /// Time goes on. What takes much longer than a look was a halt of this machine, not a silence of the owner.
  void look(Clock::time_point now);

  bool is_named() const { return bool(named_); }
  const std::optional<Address>& owner() const { return owner_; }
  /// The owner, which is not the named peer, has not been heard for the limit.
  bool is_silent() const { return !named_ && owner_ && silence_ >= limit_; }
  /// Does what that sender says count? It is the owner, or may become it.
  bool may_speak(const Address& sender) const { return !owner_ || *owner_ == sender || is_silent(); }

  /// That sender, who may speak, has said something valid: it is the owner from now on.
  void heard(const Address& sender, Clock::time_point now);
  /// The owner is there no more: its port is closed, its stream has ended.
  void gone();

  void count_stranger(const Address& sender);

  /// From any thread.
  void add_to(LinkReport& report) const;
  std::uint64_t takeovers() const;

 private:
  std::chrono::nanoseconds limit_;
  Address named_;
  std::optional<Address> owner_;
  Clock::time_point begin_{}, looked_{};
  Clock::duration silence_{};

  struct Stranger {
    Address address;
    std::uint64_t times;
  };
  mutable std::mutex mutex_;
  std::vector<Stranger> strangers_;
  std::uint64_t more_strangers_ = 0, takeover_count_ = 0;
  std::vector<LinkReport::Takeover> takeovers_;
};

}  // namespace jarol::distributers
